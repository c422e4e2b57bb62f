#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# plot_test.sh PLOT.PY: it draws each kind of table that it knows, and refuses what it cannot draw.
# The part that draws is skipped without matplotlib, when it has to say what installs it.
set -euo pipefail

plot=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "FAILED: $1" >&2
    exit 1
}

"$plot" --help | grep -q 'setup.sh --figures' || fail "--help does not say what installs matplotlib"
if "$plot" "$work/none" 2>"$work/said"; then fail "took a folder that is not there"; fi
grep -q "there is no" "$work/said" || fail "did not say what is missing: $(cat "$work/said")"

mkdir -p "$work/results/fig6a" "$work/empty"
cat >"$work/results/table1.csv" <<'CSV'
algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,paper_std_mm,verdict
base,13.6,0.0,47.2,10.7,13.8,46.0,11.0,calibrated
couple,3.4,0.0,66.6,4.2,,,,
CSV
cat >"$work/results/fig6a/limits.csv" <<'CSV'
algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,ci_high,seeds
base,delay,worst,160,=,ms,160,calibrated,calibrated,160,150,157,163,40
sep,delay,worst,320,>,ms,,,predicted,320,,320,,40
CSV
cat >"$work/results/fig6a/curves.csv" <<'CSV'
algorithm,impairment,task,level,unit,seed,counts,vibration_mm,stiffness_ratio,force_vibration_n
base,delay,T1,40,ms,1,true,0.10,,0.0100
base,delay,T1,80,ms,1,true,1.20,,0.0200
CSV
cat >"$work/results/trajectories.csv" <<'CSV'
algorithm,time_s,cube_l_mm,cube_r_mm,hand_l_mm,hand_r_mm,force_l_n,force_r_n
sep,0.000,0.0,0.0,-25,25,0.1,-0.1
sep,0.005,1.0,-3.0,-24,25,0.1,-0.1
CSV
cat >"$work/results/bench.csv" <<'CSV'
subject,later_us,share_percent
hapnet,0,10
hapnet,100,99.5
CSV

code=0
"$plot" "$work/results" --format svg >"$work/out" 2>"$work/said" || code=$?
if ((code == 3)); then
    grep -q 'scripts/setup.sh --figures' "$work/said" || fail "did not say what installs matplotlib"
    echo "skipped: python3-matplotlib is missing"
    exit 77
fi
((code == 0)) || fail "exit code $code: $(cat "$work/said")"
for name in table1 limit-delay curve-delay-T1-vibration_mm curve-delay-T1-force_vibration_n fig7 \
    lateness; do
    grep -q '<svg' "$work/results/plots/$name.svg" || fail "no $name.svg"
done
(($(wc -l <"$work/out") == 6)) || fail "six figures, not $(cat "$work/out")"
"$plot" "$work/results/fig6a" --out "$work/pdf" >/dev/null
[[ $(head -c 4 "$work/pdf/limit-delay.pdf") == %PDF ]] || fail "no PDF by default"
cp "$work/results/table1.csv" "$work/results/fig6a"
if "$plot" "$work/results" >/dev/null 2>"$work/said"; then fail "drew one name twice"; fi
grep -q "again" "$work/said" || fail "did not say that a name comes twice"
if "$plot" "$work/empty" 2>"$work/said"; then fail "took a folder without tables"; fi
grep -q "nothing in" "$work/said" || fail "did not say that there is nothing to draw"
