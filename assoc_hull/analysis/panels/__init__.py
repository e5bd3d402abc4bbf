"""Panels of the immersed hull for seakeeping codes.

`wet_sheets` joins the strips of the surface to bands and follows what is wet of them,
`arc_division` divides it by points, `assemble_mesh` puts panels between and closes open ends, and
`hull_panels` is what is called.
"""
