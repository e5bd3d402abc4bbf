"""The cells between the lines of a net, and the closed mesh that is put on them.

`net_nodes` and `net_graph` make nodes and edges of lines, `net_faces` finds the cells between them,
`filling` puts elements on these, `closed_mesh` covers, mirrors and checks them.
"""
