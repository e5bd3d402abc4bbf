"""Table 5 of Son and Kim (2008): parameters of a shuttle tanker, and what each value is worth.

Son and Kim, J. CAD/CAM (Korea) 13(6), 2008, print one set of parameters, of a shuttle tanker of
160,000 TDW with twin skegs. Facts are repeated here so that tests need no copy of the paper.
Length, breadth and draught are not printed there; the round numbers here follow from others.
"""

from __future__ import annotations

from typing import Literal

import attrs

__all__ = ["CLASSES", "DIAMETER", "INFERRED", "PRINTED", "Class", "Printed"]

Class = Literal["input", "reproduced", "consistent", "contradictory", "not derivable"]
CLASSES: tuple[Class, ...] = (
    "input", "reproduced", "consistent", "contradictory", "not derivable",
)  # fmt: skip

INFERRED = {"Lpp": 254.0, "B": 46.0, "T": 16.0}
"""Taken as exact, m: LWL less the overhang is 254, V / (Cb Lpp T) lies between 45.999 and 46.005,
TH and TRZ add up to 16."""

DIAMETER = 6.0
"""Of the screw, m: what T, SCH and PI leave."""


@attrs.frozen
class Printed:
    """A value of the table.

    `symbol` is that of the catalogue; `text` is the number as printed, empty where the paper
    defines a parameter and prints no value.
    """

    symbol: str
    text: str
    kind: Class
    why: str

    @property
    def number(self) -> float:
        return float(self.text)

    @property
    def half_unit(self) -> float:
        """Half a unit of the last digit."""
        digits = len(self.text.partition(".")[2])
        return 0.5 * 10.0**-digits


_MEASURED = "measured; others are computed from it"
_ALONE = "measured; no other value is computed from it"
_RATIO = "the ratio of two values of the table"

_ROWS: tuple[tuple[str, str, Class, str], ...] = (
    ("Cb", "0.8303", "reproduced", "from V and the dimensions"),
    ("Cp", "0.8323", "reproduced", "from V and Amax"),
    ("Cm", "0.9977", "reproduced", "from Amax, B and T"),
    ("LCB", "2.4137", "consistent", "from volumes and centroids of the two halves"),
    ("Amax", "734.2832", "input", _MEASURED),
    ("WSA", "17449.1086", "input", _ALONE),
    ("LWL", "258.0", "input", "measured; with SO it tells Lpp"),
    ("V", "155226.28", "input", "printed as displacement; V / (Cb Lpp T) shows that it is m3"),
    ("Cpa", "0.7755", "input", "taken for the volume of the after body, which is not printed"),
    ("LCBa", "74.4809", "input", _MEASURED),
    ("Ea", "1.2398", "consistent", "from Cpa"),
    ("Cpf", "0.8891", "consistent", "from V less the volume that Cpa gives"),
    ("LCBf", "184.2855", "input", _MEASURED),
    ("Ef", "0.6124", "consistent", "from Cpf"),
    ("Cw", "0.9191", "contradictory",
     "the mean of Cwa and Cwf, which it must be, is lower by 4.5 %"),
    ("LCF", "124.8247", "contradictory", "the centroids of the two halves give 0.1 m less"),
    ("Cwa", "0.9336", "input", "taken for the area of the waterplane aft"),
    ("Sigma_a", "0.2955", "consistent", "from Cwa and Cpa"),
    ("LCFa", "66.5508", "input", _MEASURED),
    ("Cwf", "0.8219", "input", "taken for the area of the waterplane forward"),
    ("LCFf", "190.7983", "input", _MEASURED),
    ("Sigma_f", "1.6058", "consistent", "from Cwf and Cpf"),
    ("Bluntness", "0.4137", "input", _ALONE),
    ("VCB", "8.3569", "input", _MEASURED),
    ("KMT", "17.8704", "contradictory",
     "no waterplane as large as Cw says and as long as LWL has so small an inertia"),
    ("Eangle", "59.3621", "input", _ALONE),
    ("TRZ", "2.0000", "reproduced", "T less TH"),
    ("BAR", "0.1528", "reproduced", "the section at FP is Abulb"),
    ("Cb4", "0.5270", "input", "taken for the volume abaft station 4, which is not printed"),
    ("PI", "8.7589", "input", "measured; with T and SCH it tells the screw's diameter, 6.000 m"),
    ("B'", "28.0179", "reproduced", "from B and T"),
    ("Ea'", "2.0355", "consistent", "from Cpa; the table prints its name as Ea once more"),
    ("As", "0.1169", "reproduced", "from V, Amax and the dimensions"),
    ("Cvpa'", "0.8286", "consistent", "from Cpa and Cwa"),
    ("ATT", "0.0000", "contradictory",
     "TRZ says that the transom dips 2 m: its area is not nil"),
    ("A_st3", "485.3532", "input", _MEASURED),
    ("Br03", "0.6610", "reproduced", _RATIO),
    ("Cb/(L/B)", "0.1504", "reproduced", "from V and the dimensions"),
    ("LIBA", "75.2338", "reproduced", "printed twice: all that lies forward of FP is immersed"),
    ("Cpa'", "0.6629", "input",
     "taken for volume over area at station 5, of which neither is printed"),
    ("Cwa'", "0.8669", "input", "taken for the waterplane abaft station 5, which is not printed"),
    ("Sigma_a'", "0.3948", "consistent", "from Cwa' and Cpa'"),
    ("CPR", "0.7505", "input", "taken for the volume of the run, which is not printed"),
    ("CPE", "0.7867", "consistent", "from V less run and parallel body"),
    ("TTLS", "21.5893", "not derivable",
     "at which height the slope of the tunnel is taken is not said"),
    ("SO", "4.0", "input", "measured; with LWL it tells Lpp"),
    ("TH", "14.0", "input", _MEASURED),
    ("SCH", "4.2411", "input", "measured; with T and PI it tells the screw's diameter"),
    ("SA", "7.8793", "not derivable",
     "read off the profile at the screw, of which nothing else is printed"),
    ("SBx", "5.8578", "not derivable",
     "read off the profile at the screw, of which nothing else is printed"),
    ("BL", "5.9", "input", _MEASURED),
    ("BLR", "0.0232", "reproduced", "from BL and Lpp"),
    ("BH", "12.0", "input", _ALONE),
    ("BW", "9.3620", "input", _ALONE),
    ("Abulb", "112.1883", "input", _MEASURED),
    ("SBD", "0.4822", "input", "measured; small for a screw of 6 m, perhaps a radius"),
    ("StemA", "20.6165", "not derivable",
     "a slope of the stern's profile; where it is taken is not said"),
    ("BR", "2.0", "reproduced", "from what Amax leaves of B T, bottom and side being flat"),
    ("Tau", "31.2336", "not derivable",
     "between which points of the section the angle is taken is not said"),
    ("Rangle", "8.3792", "not derivable",
     "which waterline is taken, and how its slope is averaged, is not said"),
    ("LBA", "75.2338", "input", _MEASURED),
    ("PTC", "44.7144", "input", _ALONE),
    ("Hap", "12.5560", "input", _MEASURED),
    ("PMBs", "9.0", "input", _MEASURED),
    ("PMBe", "14.8", "input", _MEASURED),
    ("L", "13.9599", "input", _MEASURED),
    ("Ldiag", "22.7466", "input", _MEASURED),
    ("L/Ldiag", "0.6137", "reproduced", _RATIO),
    ("BCL", "11.8673", "not derivable", "which side of a skeg is taken is not said"),
    ("B07", "12.0926", "input", _ALONE),
    ("S3.A1", "1.2542", "input", _MEASURED),
    ("S3.A2", "80.7930", "input", _MEASURED),
    ("S3", "0.0155", "reproduced", _RATIO),
    ("S3'.A1", "15.0757", "input", _MEASURED),
    ("S3'.A2", "53.8620", "input", _MEASURED),
    ("S3'", "0.2799", "reproduced", _RATIO),
    ("HSKEG", "12.5560", "reproduced",
     "printed twice: a skeg is as high as the hull's bottom at AP"),
    ("LSKEG", "34.7812", "input", _ALONE),
    ("ASKEG", "131.4093", "input", _ALONE),
    ("XSKEG", "110.3509", "input", _ALONE),
    ("RSKEG", "504.0624", "not derivable", "the circle is fitted to points that are not printed"),
    ("TwDS", "36.6946", "input", _ALONE),
    ("TwTTL", "4.0093", "input", _ALONE),
    ("TwVSA", "14.0366", "input", _ALONE),
    ("TwLSA", "2.5233", "input", _ALONE),
    ("Rfwd", "", "not derivable", "defined, but no value is printed"),
    ("Raft", "", "not derivable", "defined, but no value is printed"),
)  # fmt: skip

PRINTED = {row[0]: Printed(*row) for row in _ROWS}
"""The table, by symbol of the catalogue, in its order."""
