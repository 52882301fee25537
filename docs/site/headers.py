"""The headers that are installed: what the reference of C++ is about."""
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def public_headers():
    """Names as src/install.cmake lists them, relative to src/."""
    listed = re.search(r"set\(public_headers(.*?)\)", (ROOT / "src/install.cmake").read_text(encoding="utf-8"), re.DOTALL)
    return sorted(listed[1].split())
