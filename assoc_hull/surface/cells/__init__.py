"""The cells between the lines of a net, and the closed mesh that is put on them."""
