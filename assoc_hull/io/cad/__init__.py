"""Surfaces for and from CAD programs through OpenCASCADE, the extra ``cad``.

Out: `write` makes faces of both halves (`both_sides`, `faces`), has them written (`step_write`,
`iges_write`) and checked (`check`, by what `found` and `free_edges` measure) before a file is kept.
In: `step_text` looks at the text, `read` takes the faces. `kernel` is OpenCASCADE itself.
"""
