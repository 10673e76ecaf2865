#!/usr/bin/env bash
# Draws the pictures of docs/viewer.md, docs/images/viewer/*.png, with the tool of build/release (see demo.sh): the
# window as it is, driven by scripts on a display that nobody sees.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

shlight=${SHLIGHT:-$PWD/build/release/bin/shlight}
images=$PWD/docs/images/viewer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$images" "$work/files"

# drive [ARGUMENT…] <SCRIPT
drive() {
  cat >"$work/script"
  (cd "$work/files" && xvfb-run -a -s "-screen 0 1280x800x24 +extension GLX" "$shlight" view "$@" --script "$work/script")
}

# shot NAME [ARGUMENT…] <SCRIPT: and a picture in the end.
shot() {
  local name=$1
  shift
  { cat; printf '\nwait 64\nscreenshot %s\n' "$images/$name.png"; } | drive "$@"
  echo "$images/$name.png"
}

shot first </dev/null

# The section of Â is opened.
shot insight builtin:sphere --light builtin:sky:elevation=20,azimuth=-60 <<'END'
set method irradiance
set bands 3
set window none
set insight on
wait
click 975 632
END

shot degree builtin:sphere --light builtin:studio <<'END'
set method irradiance
set bands 4
set window none
set show degree:2
set mark-negative on
set insight on
set compare split
set side b
set method irradiance
set show normals
set side a
END

shot vertex builtin:scene --light builtin:sky:elevation=30,azimuth=-60 <<'END'
set transfer interreflected
set insight on
set camera 30,14,1.15
wait
click 560 500
END

shot visibility builtin:scene <<'END'
set show visibility
set timing on
wait
wheel -3
spin 200
END

shot keys builtin:scene --light builtin:sky:elevation=8,azimuth=-110,turbidity=3 <<'END'
set keys on
END

shot method builtin:knot --light builtin:studio <<'END'
set method hybrid
set bands 5
set window none
set material ggx:alpha=0.15,f0=0.9/0.65/0.3
set camera 20,12,1.15
END

# Lights to choose from, and one that cannot be read.
for light in studio axes thesis; do
  "$shlight" convert-map "builtin:$light" --size 512 -o "$work/files/$light.hdr"
done
"$shlight" project builtin:sky --bands 5 -o "$work/files/sky_5_bands.json"
head -c 3000 "$work/files/axes.hdr" >"$work/files/torn.hdr"
shot files builtin:scene --light axes.hdr <<'END'
wait
open thesis.hdr
wait
open studio.hdr
wait
open torn.hdr
wait
click 190 133
END

# What is seen while a bake goes on.
drive builtin:scene --light builtin:studio <<END
set transfer interreflected
set samples 2048
set camera -20,14,1.1
frames 700
screenshot $images/bake.png
END

# Both of one reference.
shot difference builtin:knot --light builtin:studio <<END
set camera 20,12,1.15
set transfer interreflected
set bands 3
set window none
set side b
set method reference
set transfer interreflected
set side a
set compare split
wait 64
screenshot $images/split.png
set compare difference
END
