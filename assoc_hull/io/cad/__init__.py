"""Surfaces for and from CAD programs through OpenCASCADE, the extra ``cad``.

Out: `write` makes faces of both halves (`faces`), writes STEP or IGES, and has the file read back
and compared (`check_file`) before it is kept. In: `read` checks the text and takes the faces.
`kernel` is OpenCASCADE itself.
"""
