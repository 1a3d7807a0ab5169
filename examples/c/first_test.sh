#!/bin/sh
# first_test.sh ifsm.h first.c: the program in the header's opening comment is first.c, letter for letter.
awk '/^ \*     #include <ifsm.h>/ { on = 1 }
     on && !/^ \*(     |$)/ { exit }
     on { sub(/^ \*(     )?/, ""); print }' "$1" | sed -e :a -e '/^\n*$/{$d;N;ba' -e '}' | diff - "$2"
