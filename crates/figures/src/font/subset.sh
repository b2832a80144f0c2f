#!/usr/bin/env bash
# The two faces of the figures from the whole DejaVu fonts (Debian: fonts-dejavu-core), with fonttools of PyPI. Latin, Greek, Cyrillic,
# raised and lowered digits, punctuation, arrows, mathematics; no hints, kerning alone of the layout features.
#   crates/figures/src/font/subset.sh /usr/share/fonts/truetype/dejavu
set -euo pipefail
for face in DejaVuSans DejaVuSans-Bold; do
    pyftsubset "$1/$face.ttf" --output-file="$(dirname "$0")/$face.ttf" --layout-features=kern --no-hinting \
        --unicodes=U+0020-007E,U+00A0-024F,U+0370-03FF,U+0400-045F,U+2000-206F,U+2070-209F,U+20AC,U+2100-214F,U+2190-2199,U+2200-22FF
done
