#!/bin/sh
# installed_test.sh <build folder> <cmake> <C compiler>
# Installs the build to a fresh prefix, then builds and runs the examples against it in the four ways that users do.
set -eu
build=$1 cmake=$2 cc=$3
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

"$cmake" --install "$build" --prefix "$prefix" > "$work/install.log"
pc=$(find "$prefix" -name ifsm.pc)
lib=$(dirname "$(dirname "$pc")")
export PKG_CONFIG_PATH="$(dirname "$pc")"

# run <how> <folder of the programs> <does it use libifsm.so?>
run() {
  (cd "$2" && LD_LIBRARY_PATH=$lib ./first && LD_LIBRARY_PATH=$lib ./fit > fit.txt 2> fit.log)
  for program in first fit; do
    used=no
    if readelf -d "$2/$program" | grep -q 'NEEDED.*libifsm\.so'; then used=yes; fi
    if [ $used != "$3" ]; then echo "$1: $program uses libifsm.so: $used, expected $3" >&2; exit 1; fi
  done
  cmp "$2/fit.txt" "$work/fit.txt" 2> /dev/null || [ ! -e "$work/fit.txt" ]  # all four print the same
  cp "$2/fit.txt" "$work/fit.txt"
  echo "$1: fine"
}

by_pkg_config() {
  mkdir "$work/$1"
  for program in first fit; do
    # shellcheck disable=SC2086 # flags are words
    "$cc" -std=c99 -Wall -Wextra -Werror -pedantic "$here/$program.c" -o "$work/$1/$program" $2
  done
}
by_pkg_config pkg_shared "$(pkg-config --cflags --libs ifsm)"
run "pkg-config, shared" "$work/pkg_shared" yes
by_pkg_config pkg_static "$(pkg-config --cflags --static --libs ifsm | sed 's/-lifsm/-l:libifsm.a/')"
run "pkg-config, static" "$work/pkg_static" no

by_find_package() {
  mkdir "$work/$1"
  cat > "$work/$1/CMakeLists.txt" << EOF
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES $3)
find_package(ifsm 0.1 REQUIRED)
foreach(program first fit)
  add_executable(\${program} $here/\${program}.c)
  target_link_libraries(\${program} PRIVATE $2)
endforeach()
EOF
  "$cmake" -S "$work/$1" -B "$work/$1/b" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" > "$work/$1.log"
  "$cmake" --build "$work/$1/b" >> "$work/$1.log" || { cat "$work/$1.log" >&2; exit 1; }
}
by_find_package cmake_shared ifsm::ifsm C
run "find_package, shared" "$work/cmake_shared/b" yes
by_find_package cmake_static ifsm::ifsm_static "C CXX"
run "find_package, static" "$work/cmake_static/b" no
