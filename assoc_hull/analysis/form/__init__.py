"""Form parameters of a hull: a catalogue of definitions, and their values.

`parameter` says what an entry of the catalogue and its value are, `floating_shape` what is
measured, `form_parameters` puts them together; `entries` holds the entries, by subject, `catalogue`
their order.
"""
