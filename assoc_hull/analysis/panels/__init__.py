"""Panels of the immersed hull for seakeeping codes.

`bands` joins the strips of the surface to long ones, `levels` chooses and completes the curves
across them, `sheets` follows what is wet of them, `division` parts it into points, `fill` and
`caps` put panels between, and `build` is what is called.
"""
