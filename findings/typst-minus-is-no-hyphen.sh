#!/usr/bin/env bash
# A negative number computed by Typst is printed with U+2212: copied from the PDF, Python does not read it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --no-compile --disable-pip-version-check typst==0.15.0 pypdf==7.1.0
venv/bin/python -W ignore - <<'PYTHON'
import sys
from importlib.metadata import version
from io import BytesIO

import pypdf
import typst

page = b'#set page(width: 10cm, height: 3cm)\n#(-1.5) #str(-7)'
with open("page.typ", "wb") as file:
    file.write(page)
words = pypdf.PdfReader(BytesIO(typst.compile("page.typ"))).pages[0].extract_text().split()
print("typst", version("typst"), "pypdf", version("pypdf"), "- the text of the page:", ", ".join(map(ascii, words)))
unread = []
for word in words:
    try:
        float(word)
    except ValueError as error:
        unread.append(word)
        print(error)
if unread != ["\u22121.5", "\u22127"]:
    sys.exit("differs: numbers copied from the page are read")
PYTHON
