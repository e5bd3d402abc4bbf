"""Files of Rhino, .3dm, written and read by rhino3dm."""
