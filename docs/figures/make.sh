#!/usr/bin/env bash
# Draws every picture of README.md, docs/ and cases/*/README.md: runs the cases, joins them with their references, calls gnuplot.
#   docs/figures/make.sh [PROGRAM]      default: build/raytube; needs gnuplot, matplotlib, ParaView, xvfb and chromium, a few minutes on two cores
set -euo pipefail
program=$(readlink -f "${1:-build/raytube}")
cd "$(dirname "$(readlink -f "$0")")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { # NAME CASE [options]
  local name=$1 file=$2
  shift 2
  "$program" run "$file" -o "$work/$name" --quiet --parts --set output.plots=false "$@"
  grep -v '^#' "$work/$name/rcs.csv" | cut -d, -f1-17 >"$work/$name.csv"  # keys, S, sigma
}
off=(--set 'edges.method="none"')
fine=(--set tubes.per_wavelength=40)

run plate cases/plate/case.toml
run dihedral cases/dihedral/case.toml
run dihedral_off cases/dihedral/case.toml "${off[@]}"
run powercube cases/powercube/case.toml
run powercube_near cases/powercube/chamber.toml
run dihedral_near cases/dihedral/chamber.toml
run powercube_off cases/powercube/case.toml "${off[@]}"
run cylinder cases/cylinder/case.toml
run cylinder_off cases/cylinder/case.toml "${off[@]}"
run trihedral cases/trihedral/case.toml
run sphere cases/sphere/bistatic.toml
run radome cases/radome/case.toml "${off[@]}"
run dihedral_77 cases/dihedral/case.toml --set frequency.ghz=77 "${off[@]}"
run coated_sphere cases/coated_sphere/case.toml
run coated_sphere_bare cases/coated_sphere/case.toml --set 'target.material="pec"'
for body in almond wing; do
  run $body cases/$body/case.toml
  run ${body}_without cases/$body/case.toml --set surfaces.waves=false
done
rays() { # BODY LOOK RADAR EYE EVERY: rays over it
  "$program" trace cases/$1/case.toml --look "$2" --surface-rays "$work/$1_$2.vtp" >/dev/null
  python3 docs/figures/surface_rays.py cases/$1/$1.ply "$work/$1_$2.vtp" "$3" "$4" "$5" "$work/$1_$2"
}
rays almond 0 90,0 60,150 4
rays almond 90 90,90 55,235 4
rays wing 90 90,0 45,130 3
rays wing 45 90,-45 45,75 3
tubes() { # MORE OPTIONS: of a look at the truck
  "$program" trace cases/haul_truck/case.toml --look 20 --all "$@" >/dev/null
}
tubes --tubes 1000000 --hits "$work/hits.vtu"
tubes --tubes 300 --paths "$work/paths.vtp"
"$program" check cases/haul_truck/case.toml --set look.phi_deg=10 --wedges "$work/wedges.vtp" >/dev/null
xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' pvpython docs/figures/tubes.py "$work"/{hits.vtu,paths.vtp,wedges.vtp} docs/figures/haul_truck_tubes.png
run haul_truck cases/haul_truck/case.toml
grep -v '^#' "$work/haul_truck/rcs.csv" >"$work/haul_truck_errors.csv"
(cd "$work" && "$program" statistics haul_truck/rcs.csv -o truck_statistics >/dev/null)
cp "$work/truck_statistics/statistics.png" docs/figures/haul_truck_statistics.png
run all_round cases/powercube/case.toml --set frequency.ghz=10 --set 'look.theta_deg={start=0,stop=180,step=1}' \
  --set 'look.phi_deg={start=-180,stop=180,step=1}'
"$program" plot "$work/all_round/rcs.csv" -o "$work/pictures/powercube_sphere.png" --quiet --title '90 mm cube, 10 GHz, monostatic, all round'
cp "$work/pictures/powercube_sphere.png" docs/figures/
for body in cube2 dihedral3; do
  run $body docs/figures/$body.toml "${fine[@]}"
  run ${body}_off docs/figures/$body.toml "${fine[@]}" "${off[@]}"
  grep -E '^theta_deg|,az_th90$' tests/data/mom/$body.csv >"$work/${body}_mom.csv"
done
run dihedral3_sharp docs/figures/dihedral3.toml "${fine[@]}" --set edges.between=false
for name in plate dihedral powercube cylinder trihedral radome coated_sphere; do grep -v '^#' cases/$name/reference.csv >"$work/${name}_reference.csv"; done
grep -v '^#' cases/sphere/reference_bistatic.csv >"$work/sphere_reference.csv"
"$program" converge cases/convergence/case.toml -o "$work/convergence_plate" >/dev/null
"$program" converge cases/convergence/dihedral.toml -o "$work/convergence_dihedral" >/dev/null
cases/stochastic/run.py "$program"
cp cases/stochastic/out/error_time.png docs/figures/stochastic.png
cp cases/stochastic/out/image/compare.png docs/figures/stochastic_image.png
for name in convergence_plate convergence_dihedral; do cp "$work/$name/converge.png" docs/figures/$name.png; done
"$program" run cases/trihedral/case.toml -o "$work/image" --quiet --set output.image_look=90
for name in image image_window; do cp "$work/image/$name.png" docs/figures/trihedral_$name.png; done
"$program" run cases/haul_truck/case.toml -o "$work/front" --quiet --set look.phi_deg=0 --set output.image_look=0
cp "$work/front/image_window.png" docs/figures/haul_truck_image.png
"$program" run cases/haul_truck/case.toml -o "$work/report" --quiet --parts --set 'look.phi_deg={start=0,stop=30,step=0.5}'
"$program" report "$work/report" --looks 20 --quiet
chromium --headless --no-sandbox --use-gl=swiftshader --enable-unsafe-swiftshader --screenshot="$work/report.png" --window-size=1100,4200 \
  --virtual-time-budget=20000 "file://$work/report/report.html"
/usr/bin/python3 -c "from PIL import Image; Image.open('$work/report.png').convert('RGB').crop((0, 2160, 1080, 3045)).save('docs/figures/report.png')"
"$program" profile cases/haul_truck/profile.toml -o "$work/truck_profile" --padding 16 --quiet
"$program" isar cases/turntable/case.toml -o "$work/turntable" --quiet
/usr/bin/python3 docs/figures/first_page.py "$work/turntable/isar.csv" "$work/dihedral3/rcs.csv" "$work/dihedral3_off/rcs.csv" docs/figures
spectrogram() { # CASE DECIBELS [options]: of a case, HH
  local name=$1 decibels=$2
  shift 2
  "$program" doppler "cases/$name/case.toml" -o "$work/$name" --spectrogram --quiet "$@"
  "$program" plot "$work/$name/spectrogram.csv" --channels hh --range "$decibels" -o docs/figures/$name.png --quiet
}
spectrogram rotor 55 --window-length 24 --overlap 0.9
spectrogram wheel 35 --middle-velocity 5
spectrogram pendulum 30
run drive_by cases/drive_by/case.toml
PYTHONPATH="$(dirname "$program")/python" /usr/bin/python3 docs/figures/drive_by.py "$work/drive_by/rcs.csv" docs/figures/drive_by.png
grep -v '^[#a-z]' "$work/truck_profile/profile.csv" >"$work/truck_profile.csv"
for name in double_slit/case double_slit/study open_box/case; do
  "$program" sources cases/$name.toml -o "$work/$name" --quiet
done
for name in launch hits; do cp "$work/double_slit/case/$name.png" docs/figures/double_slit_$name.png; done
cp "$work/double_slit/study/sources.png" docs/figures/double_slit_error.png
cp "$work/open_box/case/sources.png" docs/figures/open_box.png
cases/papers/run --only slits -o "$work/papers" "$program"
cp "$work/papers/slits_published.png" docs/figures/papers.png
# theta along the plate's cut is signed: phi = 180 counts negative.
paste -d, "$work/plate.csv" "$work/plate_reference.csv" >"$work/plate_both.csv"
for name in dihedral dihedral_off; do
  paste -d, "$work/$name.csv" "$work/${name%_off}_reference.csv" >"$work/${name}_both.csv"
done
for name in sphere radome coated_sphere; do paste -d, "$work/$name.csv" "$work/${name}_reference.csv" >"$work/${name}_both.csv"; done

cd docs/figures
pictures=(plate dihedral chamber radome cube2 dihedral3 sphere coated_sphere powercube cylinder almond almond_rays wing wing_rays trihedral haul_truck haul_truck_image haul_truck_tubes haul_truck_statistics haul_truck_profile powercube_sphere convergence_plate
          convergence_dihedral stochastic stochastic_image double_slit_launch double_slit_hits double_slit_error open_box)
gnuplot -d <<EOF
set datafile separator ','
set datafile missing '-inf'
set encoding utf8
work = '$work/'
db(re, im) = 20*log10(abs(re + {0,1}*im) + 1e-300) + 10*log10(4*pi)
diff(re, im, re0, im0) = db(re, im) - db(re0, im0)
canvas(name, w, h) = sprintf("set terminal pngcairo size %d,%d font 'DejaVu Sans,11' background rgb 'white'; set output '%s.png'", w, h, name)
set grid lt 1 lw 1 lc rgb '#dddddd'
set key outside right top vertical Left reverse samplen 2.5 spacing 1.2
set style line 1 lc rgb '#1f5fbf' lw 2           # edges on
set style line 2 lc rgb '#d9480f' lw 2           # edges off
set style line 3 lc rgb '#b8b8b8' lw 6           # reference, broad and underneath
set style line 4 lc rgb '#222222' lw 1 pt 6 ps 0.6
set ylabel 'σ (dBsm)'
set rmargin 30
set lmargin 10

eval canvas('plate', 900, 640)
set multiplot layout 2,1 title '1.5 m square plate, 3 GHz, monostatic, edges off'
set xlabel 'θ (deg, negative: φ = 180°)'
set xrange [-45:45]
set yrange [-25:45]
x(theta, phi) = phi > 90 ? -theta : theta
plot work.'plate_reference.csv' using (x(\$2,\$3)):(db(\$6,\$7)) with lines ls 3 title 'closed form (PO)', \
     work.'plate.csv' using (x(\$2,\$3)):(db(\$6,\$7)) with lines lc rgb '#1f5fbf' lw 1.2 title 'raytube, VV = HH'
set ylabel '|error| (dB)'
set logscale y
set format y '10^{%T}'
set yrange [1e-14:1e-8]
plot work.'plate_both.csv' using (x(\$2,\$3)):(db(\$23,\$24) > -2 ? abs(diff(\$6,\$7,\$23,\$24)) + 1e-15 : NaN) with points ls 4 title 'within 40 dB of peak'
unset multiplot
unset logscale y
set format y '%h'
set ylabel 'σ (dBsm)'

eval canvas('dihedral', 1000, 900)
set multiplot layout 3,1 title '150 mm dihedral, 94 GHz, θ = 90°, monostatic'
set xlabel 'φ (deg)'
set xrange [0:90]
set yrange [0:35]
set xtics 15
plot work.'dihedral_reference.csv' using 3:(db(\$6,\$7)) with lines ls 3 title 'VV closed form (PO)', \
     work.'dihedral_off.csv' using 3:(db(\$6,\$7)) with lines ls 2 lw 1.6 title 'VV raytube, edges off'
plot work.'dihedral_reference.csv' using 3:(db(\$12,\$13)) with lines ls 3 title 'HH closed form (PO)', \
     work.'dihedral_off.csv' using 3:(db(\$12,\$13)) with lines ls 2 lw 1.6 title 'HH raytube, edges off'
set ylabel 'raytube − closed form (dB)'
set yrange [-2.2:1.2]
plot work.'dihedral_both.csv' using 3:(diff(\$6,\$7,\$23,\$24)) with lines lc rgb '#1f5fbf' lw 1.6 title 'VV edges on', \
     work.'dihedral_both.csv' using 3:(diff(\$12,\$13,\$29,\$30)) with lines lc rgb '#8a1fbf' lw 1.6 dt (8,6) title 'HH edges on', \
     work.'dihedral_off_both.csv' using 3:(diff(\$6,\$7,\$23,\$24)) with lines lc rgb '#d9480f' lw 1.6 title 'VV edges off', \
     work.'dihedral_off_both.csv' using 3:(diff(\$12,\$13,\$29,\$30)) with lines lc rgb '#2e8b3d' lw 1.6 dt (8,6) title 'HH edges off'
unset multiplot
set ylabel 'σ (dBsm)'

eval canvas('cube2', 900, 700)
set multiplot layout 2,1 title 'Cube of 2 wavelengths, θ = 90°, monostatic, 40 tubes per wavelength'
set xrange [0:90]
set xtics 15
set yrange [-45:-5]
plot work.'cube2_mom.csv' using 2:(db(\$4,\$5)) with lines ls 3 title 'VV method of moments', \
     work.'cube2_off.csv' using 3:(db(\$6,\$7)) with lines ls 2 title 'VV raytube, edges off', \
     work.'cube2.csv' using 3:(db(\$6,\$7)) with lines ls 1 dt (8,6) title 'VV raytube, edges on'
plot work.'cube2_mom.csv' using 2:(db(\$10,\$11)) with lines ls 3 title 'HH method of moments', \
     work.'cube2_off.csv' using 3:(db(\$12,\$13)) with lines ls 2 title 'HH raytube, edges off', \
     work.'cube2.csv' using 3:(db(\$12,\$13)) with lines ls 1 dt (8,6) title 'HH raytube, edges on'
unset multiplot

eval canvas('dihedral3', 900, 700)
set multiplot layout 2,1 title 'Dihedral of 3 wavelengths, θ = 90°, monostatic'
set xrange [-60:60]
set yrange [-25:5]
plot work.'dihedral3_mom.csv' using 2:(db(\$4,\$5)) with lines ls 3 title 'VV method of moments', \
     work.'dihedral3_off.csv' using 3:(db(\$6,\$7)) with lines ls 2 title 'VV raytube, edges off', \
     work.'dihedral3_sharp.csv' using 3:(db(\$6,\$7)) with lines lc rgb '#2e8b3d' lw 1.4 title 'VV edges, nothing between', \
     work.'dihedral3.csv' using 3:(db(\$6,\$7)) with lines ls 1 dt (8,6) title 'VV raytube, edges on'
plot work.'dihedral3_mom.csv' using 2:(db(\$10,\$11)) with lines ls 3 title 'HH method of moments', \
     work.'dihedral3_off.csv' using 3:(db(\$12,\$13)) with lines ls 2 title 'HH raytube, edges off', \
     work.'dihedral3_sharp.csv' using 3:(db(\$12,\$13)) with lines lc rgb '#2e8b3d' lw 1.4 title 'HH edges, nothing between', \
     work.'dihedral3.csv' using 3:(db(\$12,\$13)) with lines ls 1 dt (8,6) title 'HH raytube, edges on'
unset multiplot

eval canvas('sphere', 900, 700)
set multiplot layout 2,1 title 'Sphere of 1 m radius (20 480 facets), 3 GHz, bistatic'
set xlabel 'bistatic angle (deg, 0 is backscatter)'
set xrange [0:180]
set xtics 30
set yrange [-10:50]
plot work.'sphere_reference.csv' using 5:(db(\$6,\$7)) with lines ls 3 title 'E across plane, Mie', \
     work.'sphere_reference.csv' using 5:(db(\$12,\$13)) with lines lc rgb '#cdb4e8' lw 6 title 'E in plane, Mie', \
     work.'sphere.csv' using 5:(db(\$12,\$13)) with lines lc rgb '#8a1fbf' lw 1.6 title 'E in plane, raytube', \
     work.'sphere.csv' using 5:(db(\$6,\$7)) with lines ls 1 lw 1.6 dt (8,6) title 'E across plane, raytube'
set ylabel 'raytube − Mie (dB)'
set yrange [-3:3]
plot work.'sphere_both.csv' using 5:(diff(\$12,\$13,\$29,\$30)) with lines lc rgb '#8a1fbf' lw 1.6 title 'E in plane (HH)', \
     work.'sphere_both.csv' using 5:(diff(\$6,\$7,\$23,\$24)) with lines ls 1 lw 1.6 title 'E across plane (VV)'
unset multiplot
set ylabel 'σ (dBsm)'

eval canvas('radome', 900, 700)
set multiplot layout 2,1 title '150 mm dihedral behind a flat radome, 77 GHz, θ = 90°, monostatic'
set xlabel 'φ (deg)'
set xrange [30:60]
set xtics 5
set yrange [20:32]
plot work.'dihedral_77.csv' using 3:(db(\$6,\$7)) with lines lc rgb '#2e8b3d' lw 1.4 title 'VV without the radome', \
     work.'radome_reference.csv' using 3:(db(\$6,\$7)) with lines ls 3 title 'VV closed form', \
     work.'radome.csv' using 3:(db(\$6,\$7)) with lines ls 1 lw 1.6 title 'VV raytube', \
     work.'radome_reference.csv' using 3:(db(\$12,\$13)) with lines lc rgb '#cdb4e8' lw 6 title 'HH closed form', \
     work.'radome.csv' using 3:(db(\$12,\$13)) with lines lc rgb '#8a1fbf' lw 1.6 title 'HH raytube'
set ylabel 'raytube − closed form (dB)'
set yrange [-0.05:0.05]
plot work.'radome_both.csv' using 3:(diff(\$6,\$7,\$23,\$24)) with lines ls 1 lw 1.6 title 'VV', \
     work.'radome_both.csv' using 3:(diff(\$12,\$13,\$29,\$30)) with lines lc rgb '#8a1fbf' lw 1.6 title 'HH'
unset multiplot
set ylabel 'σ (dBsm)'

eval canvas('coated_sphere', 900, 700)
set multiplot layout 2,1 title 'Sphere of 1 m radius with an absorbing coat of 5 mm, monostatic'
set xlabel 'frequency (GHz)'
set xrange [2:5]
set xtics 0.5
set yrange [-35:10]
plot work.'coated_sphere_bare.csv' using (\$1/1e9):(db(\$6,\$7)) with lines lc rgb '#2e8b3d' lw 1.4 title 'without coat, raytube', \
     work.'coated_sphere_reference.csv' using (\$1/1e9):(db(\$6,\$7)) with lines ls 3 title 'exact series', \
     work.'coated_sphere.csv' using (\$1/1e9):(db(\$6,\$7)) with lines ls 1 lw 1.6 title 'raytube, VV'
set ylabel 'raytube − series (dB)'
set yrange [-0.8:0.8]
plot work.'coated_sphere_both.csv' using (\$1/1e9):(diff(\$6,\$7,\$23,\$24)) with lines ls 1 lw 1.6 title 'VV', \
     work.'coated_sphere_both.csv' using (\$1/1e9):(diff(\$12,\$13,\$29,\$30)) with lines lc rgb '#8a1fbf' lw 1.6 title 'HH'
unset multiplot
set ylabel 'σ (dBsm)'

eval canvas('powercube', 900, 700)
set multiplot layout 2,1 title '90 mm cube, 94 GHz, θ = 90°, monostatic'
set xlabel 'φ (deg)'
set xrange [-10:10]
set xtics 2
set yrange [-35:25]
plot work.'powercube_reference.csv' using 3:(db(\$6,\$7)) with lines ls 3 title 'closed form (PO)', \
     work.'powercube_off.csv' using 3:(db(\$6,\$7)) with lines ls 2 lw 1.6 title 'raytube, edges off'
plot work.'powercube_off.csv' using 3:(db(\$6,\$7)) with lines lc rgb '#f0b090' lw 5 title 'edges off', \
     work.'powercube.csv' using 3:(db(\$6,\$7)) with lines ls 1 lw 1.6 title 'VV edges on', \
     work.'powercube.csv' using 3:(db(\$12,\$13)) with lines lc rgb '#8a1fbf' lw 1.6 dt (8,6) title 'HH edges on'
unset multiplot

eval canvas('chamber', 900, 700)
set rmargin 36
set multiplot layout 2,1 title '94 GHz, θ = 90°, monostatic, VV, edges on: far field and chamber'
set xlabel 'φ (deg)'
set xrange [-10:10]
set xtics 2
set yrange [-25:25]
plot work.'powercube.csv' using 3:(db(\$6,\$7)) with lines lc rgb '#f0b090' lw 4 title 'cube 90 mm, far field', \
     work.'powercube_near.csv' using 3:(db(\$6,\$7)) with lines ls 1 lw 1.6 title 'cube 90 mm, radar at 2 m'
set xrange [0:90]
set xtics 15
set yrange [-5:35]
plot work.'dihedral.csv' using 3:(db(\$6,\$7)) with lines lc rgb '#f0b090' lw 4 title 'dihedral 150 mm, far field', \
     work.'dihedral_near.csv' using 3:(db(\$6,\$7)) with lines ls 1 lw 1.6 title 'dihedral 150 mm, radar at 5 m'
unset multiplot
set rmargin 30

eval canvas('cylinder', 900, 700)
set multiplot layout 2,1 title 'Cylinder, radius 90 mm, length 300 mm, 10 GHz, monostatic'
set xlabel 'θ (deg)'
set xrange [0:180]
set xtics 30
set yrange [-45:15]
plot work.'cylinder_reference.csv' using 2:(db(\$6,\$7)) with lines ls 3 title 'closed form (PO)', \
     work.'cylinder_off.csv' using 2:(db(\$6,\$7)) with lines ls 2 lw 1.6 title 'raytube, edges off'
plot work.'cylinder_off.csv' using 2:(db(\$6,\$7)) with lines lc rgb '#f0b090' lw 5 title 'edges off', \
     work.'cylinder.csv' using 2:(db(\$6,\$7)) with lines ls 1 lw 1.6 title 'VV edges on', \
     work.'cylinder.csv' using 2:(db(\$12,\$13)) with lines lc rgb '#8a1fbf' lw 1.6 dt (8,6) title 'HH edges on'
unset multiplot

do for [body in "almond wing"] {
eval canvas(body, 900, 700)
set rmargin 34
set xlabel body eq 'almond' ? 'φ (deg): 0 tip, 180 round end' : 'φ (deg): 0 nose, 25 across the leading edge'
if (body eq 'almond') {
set multiplot layout 2,1 title 'NASA almond of 252 mm, 7 GHz, θ = 90°, monostatic'
set xrange [0:180]
set xtics 30
set yrange [-65:-15]
} else {
set multiplot layout 2,1 title 'Swept wing of 4 by 6 wavelengths, θ = 90°, monostatic'
set xrange [-90:90]
set xtics 15
set yrange [-65:0]
}
do for [pq in "VV HH"] {
c = pq eq 'VV' ? 6 : 12
plot work.body.'_without.csv' using 3:(db(column(c), column(c+1))) with lines ls 2 lw 1.6 title pq.' without waves over it', \
     work.body.'.csv' using 3:(db(column(c), column(c+1))) with lines ls 1 lw 1.6 title pq.' with waves over it'
}
unset multiplot
}

set style arrow 1 head filled lw 3 lc rgb '#222222'
set datafile separator whitespace
views(body) = body eq 'almond' ? "0 90" : "90 45"
do for [body in "almond wing"] {
eval canvas(body.'_rays', 1100, 560)
unset border; unset tics; unset xlabel; unset ylabel; unset grid
set autoscale
set lmargin 2; set rmargin 2
set size ratio -1
set key below horizontal Left reverse samplen 2 width 2
set multiplot layout 1,2 title body eq 'almond' ? 'Rays over the almond: radar at the tip (φ = 0) and at the side (φ = 90°)' : 'Rays over the wing: radar at the nose (φ = 0) and at φ = −45°'
do for [look in views(body)] {
at = work.body.'_'.look
plot at.'_mesh.dat' using 1:2:3 with polygons fs solid 1.0 noborder fc rgb variable notitle, \
     at.'_rays.dat' using 1:(\$3 == 1 ? \$2 : NaN) with lines lw 0.7 lc rgb '#2e8b3d' title 'from edges', \
     at.'_rays.dat' using 1:(\$3 == 0 ? \$2 : NaN) with lines lw 1.2 lc rgb '#1f5fbf' title 'into the dark', \
     at.'_radar.dat' using 1:2:3:4 with vectors arrowstyle 1 title 'wave'
}
unset multiplot
}
set datafile separator ','
set border; set tics; set grid lt 1 lw 1 lc rgb '#dddddd'
set size noratio
set lmargin 10
set key default
set key outside right top vertical Left reverse samplen 2.5 spacing 1.2
set ylabel 'σ (dBsm)'

eval canvas('trihedral', 900, 420)
set rmargin 34
set title '1.5 m triangular trihedral, 3 GHz, θ = 54.74°, monostatic, edges off'
set xlabel 'φ (deg)'
set xrange [0:90]
set xtics 15
set yrange [0:40]
# bounce 3 of parts.csv: columns 5 + 2 x 8 + 1 ...
plot work.'trihedral_reference.csv' using 3:(db(\$4,0)) with lines ls 3 title 'triple bounce, closed form', \
     work.'trihedral/parts.csv' using 3:(db(\$22,\$23)) with lines ls 2 lw 1.6 title 'triple bounce, raytube', \
     work.'trihedral.csv' using 3:(db(\$6,\$7)) with lines ls 1 lw 1.6 dt (8,6) title 'all bounces, VV', \
     work.'trihedral.csv' using 3:(db(\$12,\$13)) with lines lc rgb '#8a1fbf' lw 1.6 dt (3,4) title 'all bounces, HH'

eval canvas('haul_truck', 1100, 800)
unset title
set multiplot layout 2,1 title 'Dump truck of 0.3 m, 94 GHz, θ = 90°, monostatic'
set rmargin 12
set xlabel 'φ (deg): 0 front, 90 side, 180 rear'
set xrange [0:180]
set xtics 15
set yrange [-35:15]
plot work.'haul_truck.csv' using 3:(db(\$6,\$7)) with lines ls 1 lw 1.4 title 'VV', \
     work.'haul_truck.csv' using 3:(db(\$12,\$13)) with lines lc rgb '#8a1fbf' lw 1.4 title 'HH'
set ylabel 'estimated error (dB)'
set logscale y
set yrange [0.01:10]
plot work.'haul_truck_errors.csv' using 3:18 with lines ls 1 lw 1.2 title 'VV', \
     work.'haul_truck_errors.csv' using 3:21 with lines lc rgb '#8a1fbf' lw 1.2 title 'HH', \
     0.5 with lines lc rgb '#222222' dt (8,6) title '0.5 dB'
unset multiplot

eval canvas('haul_truck_profile', 1100, 560)
set title 'Dump truck of 0.3 m, 89 to 99 GHz, seen from its front, θ = 75°'
set rmargin 12
unset logscale y
set xlabel 'range beyond the origin, away from the radar (m)'
set xrange [-0.22:0.2]
set xtics 0.05
set yrange [-50:5]
set ylabel 'σ (dBsm)'
place(text, x, y, to) = sprintf("set label '%s' at %g,%g center; set arrow from %g,%g to %g,%g head size 0.004,20 filled lc rgb '#666666'", text, x, y, x, y - 1.2, x, to)
eval place('canopy', -0.172, -1, -10)
eval place('engine housing', -0.142, 3, -3)
eval place('front tyres, cab', -0.098, -5, -13.4)
eval place('front wall of the bucket', -0.05, -1, -9.4)
eval place('rear tyres', 0.055, -14, -21.5)
eval place('rear rim of the bucket', 0.132, -16, -24.2)
plot work.'truck_profile.csv' using 5:14 with lines ls 1 title 'VV', \
     '' using 5:17 with lines lc rgb '#8a1fbf' lw 2 title 'HH'
unset label; unset arrow; unset title
EOF

# Few colours are in use: an 8-bit palette makes the files three times smaller than gnuplot's.
for name in "${pictures[@]}"; do python3 palette.py "$name.png"; done
ls -l ./*.png
