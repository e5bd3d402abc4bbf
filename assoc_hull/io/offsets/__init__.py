"""Tables of offsets: read, examined, and made a net."""
