#!/usr/bin/env bash
# Draws the pictures of the documents, docs/images/*.png, with the tool of build/release (see demo.sh).
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

shlight=$PWD/build/release/bin/shlight
images=$PWD/docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$images"

# side_by_side FILE PICTURE…
side_by_side() {
  local file=$1
  shift
  oiiotool "$@" --mosaic:pad=8 "$#x1" -o "$file"
}

"$shlight" render builtin:scene --camera 30,7,1.15 --exposure 0.6 --size 960x540 -o "$images/hero.png"

for bands in 1 2 3 5 9; do
  "$shlight" render builtin:sphere --light builtin:thesis --bands "$bands" --camera 100,20 --size 240x240 \
    -o "$work/bands_$bands.png"
done
side_by_side "$images/bands.png" "$work"/bands_{1,2,3,5,9}.png

"$shlight" render builtin:scene --light builtin:sky:elevation=8,azimuth=-110,turbidity=3 --camera 30,10,1.1 \
  --exposure 0.4 --size 300x240 -o "$work/evening.png"
for light in sky studio axes; do
  "$shlight" render builtin:scene --light "builtin:$light" --camera 30,10,1.1 --exposure 0.4 --size 300x240 \
    -o "$work/$light.png"
done
side_by_side "$images/lights.png" "$work"/{sky,evening,studio,axes}.png

# A low sun over a dark ground rings: before and after, negative light striped.
for window in none auto; do
  for model in sphere knot; do
    "$shlight" render "builtin:$model" --light builtin:sky:elevation=20,azimuth=-60,turbidity=2.5,ground=0 \
      --window "$window" --mark-negative --camera 60,-35 --exposure 1 --size 300x300 -o "$work/ringing_${model}_$window.png"
  done
done
side_by_side "$images/ringing.png" "$work"/ringing_{sphere,knot}_none.png "$work"/ringing_{sphere,knot}_auto.png

# Every kind of material in three roughnesses, each with 3, 5, 8 bands and hybrid.
# material_row FILE MODEL CAMERA MATERIAL…
material_row() {
  local file=$1 model=$2 camera=$3 pictures=() material how
  shift 3
  for material in "$@"; do
    for how in '--bands 3' '--bands 5' '--bands 8' '--method hybrid'; do
      # shellcheck disable=SC2086
      "$shlight" render "$model" --light builtin:studio --material "$material" $how --camera "$camera" \
        --size 110x110 --no-background -o "$work/material_${#pictures[@]}.png"
      pictures+=("$work/material_${#pictures[@]}.png")
    done
  done
  oiiotool "${pictures[@]}" --mosaic:pad=2 12x1 -o "$file"
}
# material_sheet FILE MODEL CAMERA
material_sheet() {
  local file=$1 model=$2 camera=$3 row=0 rows=() materials
  while read -ra materials; do
    rows+=("$work/materials_$((++row)).png")
    material_row "${rows[-1]}" "$model" "$camera" "${materials[@]}" </dev/null
  done <<END
$(echo ggx:alpha={0.05,0.2,0.5},f0=0.9/0.65/0.3)
$(echo ggx-aniso:ax={0.05,0.1,0.2},ay=0.5,f0=0.9/0.65/0.3)
$(echo cook-torrance:m={0.1,0.3,0.6},f0=0.9)
$(echo ward:rd=0.1/0.02/0.02,rs=0.4,sigma={0.05,0.15,0.4})
$(echo ward-aniso:rd=0.02/0.05/0.1,rs=0.4,sx={0.05,0.1,0.2},sy=0.5)
$(echo blinn-phong:rd=0.05/0.1/0.05,rs=0.4,n={200,50,10})
$(echo oren-nayar:rho=0.8/0.6/0.5,sigma={0,0.4,1})
$(echo metallic-roughness:base=0.7/0.1/0.1,metallic=0,roughness={0.2,0.45,0.8})
END
  oiiotool "${rows[@]}" --mosaic:pad=2 1x8 -o "$file"
}
material_sheet "$images/materials.png" builtin:sphere 30,12
if [[ -n ${SHLIGHT_TEST_DATA:-} ]]; then
  material_sheet "$images/materials_head.png" "$SHLIGHT_TEST_DATA/models/dx_Head_Sad.x" 20,5,1.15
fi

# From mirror to satin by the hybrid method; brushed metal beside the path-traced one.
hybrid=()
for alpha in 0.01 0.04 0.1 0.25; do
  "$shlight" render builtin:sphere --light builtin:sky:elevation=25,azimuth=-60,turbidity=3 --method hybrid \
    --material "ggx:alpha=$alpha,f0=0.95/0.7/0.35" --camera 30,10 --size 220x220 -o "$work/hybrid_$alpha.png"
  hybrid+=("$work/hybrid_$alpha.png")
done
for method in hybrid reference; do
  options=(--method hybrid)
  if [[ $method == reference ]]; then options=(--method reference --transfer cosine --samples 1024); fi
  "$shlight" render builtin:knot --light builtin:sky:elevation=25,azimuth=-60,turbidity=3 "${options[@]}" \
    --material ggx-aniso:ax=0.08,ay=0.35,f0=0.9/0.7/0.5 --camera 30,10,1.2 --size 220x220 -o "$work/hybrid_$method.png"
  hybrid+=("$work/hybrid_$method.png")
done
side_by_side "$images/hybrid.png" "${hybrid[@]}"

# What compression costs: bytes of a vertex's transfer against the change of radiance under the built-in lights.
bake_points() {
  local points=$1 compression
  shift
  for compression in "$@"; do
    "$shlight" bake builtin:knot -o "$work/knot.glb" --transfer interreflected --bands 5 --samples 256 \
      ${compression:+--compress "$compression"} --json >"$work/bake.json"
    python3 -c 'import json, sys
bake = json.load(open(sys.argv[1]))
name = "{clusters} x {components}".format(**bake) if bake["clusters"] else "{bits} bits".format(**bake)
print(bake["transfer_bytes_per_vertex"], bake["shading_error"]["rms"], bake["shading_error"]["max"], name, sep="\t")' \
      "$work/bake.json" >>"$work/$points"
  done
}
bake_points bits 16 8
bake_points pca64 pca:64x{3,7,11,15,23}
bake_points pca256 pca:256x{3,7,11,15,23}
echo 'bytes, root mean square, worst, what:'
cat "$work"/{bits,pca64,pca256}
gnuplot <<END
set terminal pngcairo size 960,560 font ",13" background "#ffffff"
set output "$images/compression.png"
set datafile separator "\t"
set logscale xy
set xrange [8:240]
set yrange [1e-5:0.2]
set xtics (8, 16, 32, 64, 128) nomirror
set ytics ("0.001 %%" 1e-5, "0.01 %%" 1e-4, "0.1 %%" 1e-3, "1 %%" 1e-2, "10 %%" 1e-1) nomirror
set border 3 linecolor "#666666"
set grid xtics ytics linecolor "#dddddd" linetype 1
set xlabel "bytes a vertex, tables of clusters included (as floats: 336)" textcolor "#333333"
set ylabel "error of radiance, root mean square" textcolor "#333333"
components(name) = word(name, 3)
set key bottom left reverse Left spacing 1.3 textcolor "#333333"
plot "$work/pca64" using 1:2 with linespoints linewidth 2 pointtype 7 pointsize 1.2 linecolor "#2a6fbb" \
       title "clustered PCA, 64 clusters; beside: components", \
     "$work/pca256" using 1:2 with linespoints linewidth 2 pointtype 7 pointsize 1.2 linecolor "#d1602a" \
       title "clustered PCA, 256 clusters", \
     "$work/bits" using 1:2 with points pointtype 5 pointsize 1.5 linecolor "#222222" title "fewer bits", \
     "$work/bits" using 1:2:4 with labels offset 4,0.3 textcolor "#222222" notitle, \
     "$work/pca64" using 1:2:(components(strcol(4))) with labels offset -2,-0.9 textcolor "#2a6fbb" notitle, \
     "$work/pca256" using 1:2:(components(strcol(4))) with labels offset 2,0.9 textcolor "#d1602a" notitle
END

# One light in every layout, each beside the sphere that it lights: all spheres are alike.
globe="fn:r=(0.2+0.8*max(0,x)+0.5*max(0,z))*(abs(sin(6*asin(y)))*abs(sin(6*atan2(x,-z)))*sqrt(1-y*y)>0.06?1:0.3)"
globe+="+6*max(0,0.5*x+0.62*y-0.6*z)^12;"
globe+="g=(0.2+0.8*max(0,y)+0.4*max(0,x))*(abs(sin(6*asin(y)))*abs(sin(6*atan2(x,-z)))*sqrt(1-y*y)>0.06?1:0.3)"
globe+="+5*max(0,0.5*x+0.62*y-0.6*z)^12;"
globe+="b=(0.2+0.8*max(0,-z)+0.5*max(0,-x))*(abs(sin(6*asin(y)))*abs(sin(6*atan2(x,-z)))*sqrt(1-y*y)>0.06?1:0.3)"
globe+="+3.2*max(0,0.5*x+0.62*y-0.6*z)^12"
mkdir -p "$images/layouts"
while read -r layout size; do
  "$shlight" convert-map "$globe" --layout "$layout" --size "$size" -o "$work/$layout.exr"
  light=$work/$layout.exr
  if [[ $layout == cube ]]; then
    light=$work/cube_px.exr
    oiiotool "$work"/cube_{px,nx,py,ny,pz,nz}.exr --mosaic:pad=8 3x2 -o "$work/cube.exr"
  fi
  "$shlight" render builtin:sphere --light "$light" --layout "$layout" --camera 200,15 --size 200x200 \
    -o "$work/sphere.png"
  oiiotool "$work/$layout.exr" --mulc 0.5 --colorconvert linear sRGB --clamp:min=0:max=1 --fit:pad=1 300x200 \
    "$work/sphere.png" --ch R,G,B --mosaic:pad=8 2x1 -o "$images/layouts/$layout.png"
done <<'END'
lat-long 600
angular-map 400
mirror-ball 400
cube 140
vertical-cross 100
horizontal-cross 100
horizontal-strip 100
vertical-strip 100
octahedral 400
openexr-lat-long 600
openexr-cube 100
END

scripts/transfer_images.sh

# What approximates beside what it approximates; how many bands lights and materials need.
"$shlight" render builtin:knot --light builtin:studio --bands 3 --camera 20,10,1.2 --size 360x300 --compare \
  -o "$images/compare.png"
font=$(fc-match --format '%{file}' sans)
pictures=()
for light in studio sky; do
  gold=(builtin:knot --light "builtin:$light" --material ggx:alpha=0.15,f0=0.95/0.7/0.35 --camera 20,10,1.2
    --size 360x360)
  "$shlight" render "${gold[@]}" --method reference --transfer cosine --samples 1024 -o "$work/reference.png"
  for how in 3 5 hybrid; do
    options=(--bands "$how") what="$how bands"
    if [[ $how == hybrid ]]; then options=(--method hybrid) what=hybrid; fi
    "$shlight" render "${gold[@]}" "${options[@]}" -o "$work/approach.png"
    "$shlight" compare "$work/approach.png" "$work/reference.png" --json >"$work/approach.json"
    flip=$(python3 -c 'import json, sys; print("{flip:.3f}".format(**json.load(open(sys.argv[1]))))' \
      "$work/approach.json")
    pictures+=("$work/approach_${#pictures[@]}.png")
    oiiotool "$work/approach.png" --text:x=12:y=346:size=17:color=1,1,1:font="$font" "${what}: FLIP $flip" \
      -o "${pictures[-1]}"
  done
  pictures+=("$work/approach_${#pictures[@]}.png")
  oiiotool "$work/reference.png" --text:x=12:y=346:size=17:color=1,1,1:font="$font" "path traced" -o "${pictures[-1]}"
done
oiiotool "${pictures[@]}" --mosaic:pad=8 4x2 -o "$images/approaches.png"
scripts/bands.py "$shlight" "$PWD"
ls -l "$images" "$images/layouts" "$images/bands"

# Figures 31 to 38 of the thesis: four materials by 3, 5 and 8 bands and path traced.
"$shlight" reproduce -o "$work/report"
thesis=()
for material in cook-torrance oren-nayar ward-aniso ward; do
  for kind in 3-bands 5-bands 8-bands reference; do
    thesis+=("$work/report/$material-$kind.png")
  done
done
oiiotool "${thesis[@]}" --mosaic:pad=8 4x4 --resize 1000x0 -o "$images/thesis.png"
