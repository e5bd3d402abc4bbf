"""Hulls that ship with the package, as nets and designs."""
