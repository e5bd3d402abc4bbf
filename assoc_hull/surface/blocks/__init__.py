"""Blocks of a hull, each the part of it that one smooth surface is fitted to.

In the order of the work: `layout` parts the half hull (`outline`, `cuts`, `bridges`, `region`,
`plan`, `corners`, `quad`, `bays`) and lays each `block` out on a rectangle (`block_map`,
`harmonic`, `run_slopes`) with its points (`block_samples`, `loose_ends`); `fitting` fits and joins
them (`fit_options`, `spans`, `fit_block`), but for what stayed since an earlier surface (`follow`,
`previous`), and measures them (`residuals`, `doubts`).
"""
