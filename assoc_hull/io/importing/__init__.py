"""The door for files of other programs: read, place, adopt, check, and say how sound it is."""
