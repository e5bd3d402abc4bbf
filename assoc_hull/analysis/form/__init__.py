"""Form parameters of a hull: a catalogue of definitions, and their values.

`parameter` says what an entry of the catalogue and its value are, `floating_shape` what is
measured; `entries` holds the entries, by subject; `form_parameters` puts them in order and gives
their values.
"""
