"""Where definitions stand: papers and the list of symbols of the towing tanks."""

from __future__ import annotations

__all__ = ["HOLTROP", "ITTC", "KRACHT", "LEWIS", "TABLE_3", "TABLE_4"]

_SON_KIM = "Son and Kim, J. CAD/CAM (Korea) 13(6), 2008"

TABLE_3 = f"{_SON_KIM}, Table 3"
TABLE_4 = f"{_SON_KIM}, Table 4"

ITTC = "ITTC Symbols and Terminology List 2021, ship geometry"

KRACHT = "Kracht, Design of bulbous bows, SNAME Transactions 86, 1978"

HOLTROP = "Holtrop and Mennen, International Shipbuilding Progress 29, no. 335, 1982"

LEWIS = "E.V. Lewis, ed., Principles of Naval Architecture, vol. I, SNAME 1988, ch. I"
