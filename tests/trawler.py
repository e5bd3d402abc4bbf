"""A trawler of few lines: a table of offsets with breadth at station 0, and no end beyond it."""

from pathlib import Path

import assoc_hull as ah

TABLE = """# Trawler 34 m, half-breadths in mm, waterlines in mm above base
ST;WL 0;WL 500;WL 1000;WL 1500;WL 2000;WL 2500;WL 3100;WL 3800;WL 4600
0;50;295;595;870;1090;1290;1530;1810;2130
1;320;1170;1805;2200;2395;2540;2705;2890;3090
2;515;1805;2665;3125;3280;3370;3465;3570;3675
3;645;2215;3205;3690;3810;3850;3890;3935;3975
4;720;2430;3475;3960;4050;4060;4070;4075;4085
5;740;2485;3540;4020;4100;4100;4100;4100;4100
6;710;2400;3435;3920;4015;4025;4040;4050;4060
7;620;2120;3065;3530;3640;3680;3725;3770;3810
8;470;1635;2385;2775;2890;2950;3015;3090;3170
9;265;930;1370;1610;1695;1745;1810;1875;1955
10;0;0;0;0;0;55;215;400;615
"""


def trawler(folder: Path, table: str = TABLE) -> ah.Hull:
    """Read the table as a person does: length, draught and deck given."""
    path = folder / "trawler.csv"
    path.write_text(table, "utf-8")
    return ah.read(path, length=34.0, draught=3.1, station_zero="ap", deck="closed")
