"""The cells between the lines of a net, and the closed mesh that is put on them.

`hull_mesh` is what is called. `net_graph` makes nodes and edges of lines (`stops`, `unnoted`,
`normals`), `sound_cells` finds cells between them (`faces`, `lenses`, `soundness`), `filling` puts
elements on these (`edge_points`, `local_frames`), `closing` covers and mirrors, `closed_mesh` is
the result and `mesh_report` what was checked of it.
"""
