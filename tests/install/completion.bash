#!/bin/bash
# What bash offers for raytube:   completion.bash FILE      FILE: the completion made for bash
set -u
source "$1"
faults=0

offered() {  # WORDS...: what is offered for the last of them, on one line
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _raytube
  echo "${COMPREPLY[*]-}"
}

expect() {  # OFFERED WORDS...
  local wanted=$1 found
  shift
  found=$(offered "$@")
  [ "$found" = "$wanted" ] && return
  echo "'${*}' offers '$found', not '$wanted'"
  faults=1
}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
touch case.toml result.csv result.nc mesh.stl
mkdir cases

expect "run" raytube ru
expect "converge centres check compare convert" raytube c
expect "merge" raytube m
expect "--version" raytube --v
expect "cases case.toml" raytube run ca
expect "case.toml" raytube run --quiet -o out case.
expect "case.toml" raytube run --set edges.order = 2 case.
expect "" raytube run case.toml ca                  # one case is enough
expect "cases" raytube run case.toml -o ca          # a folder
expect "--threads" raytube check case.toml --th
expect "edges.order=" raytube run --set edges.or
expect "" raytube run --set edges.order = ca        # a value
expect "result.csv result.nc" raytube compare result.csv res
expect "" raytube compare result.csv result.nc res
expect "auto curves map polar sphere waterfall" raytube plot result.csv --kind ""
expect "cases" raytube merge ca                     # a folder of shards
expect "case.toml" raytube merge cases case.
expect "cases" raytube statistics result.csv -o ca
exit $faults
