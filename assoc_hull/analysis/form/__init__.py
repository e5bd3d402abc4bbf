"""Form parameters of a hull: a catalogue of definitions, and their values.

`value` says what an answer is, `parameter` what an entry of the catalogue is, `shape` what is
measured, `evaluate` puts them together; all other modules hold entries, by subject.
"""
