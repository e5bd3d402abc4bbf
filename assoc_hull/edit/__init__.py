"""The modifications of a hull, one per module, and the transaction they run in."""
