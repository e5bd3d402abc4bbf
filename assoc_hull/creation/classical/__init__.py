"""Classical definitions of whole hulls, their own exact numbers, and the nets made of them."""
