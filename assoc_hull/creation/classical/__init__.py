"""Classical definitions of hulls: what they hold, what they evaluate to, nets made of them."""
