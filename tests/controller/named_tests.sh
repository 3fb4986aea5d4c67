#!/bin/sh
# Whether every test that a document names exists: `Suite.name`, of a TEST, TEST_F or TEST_P; or `file/name`, of a
# situation, `heroes/file/name` of one of a hero.
# usage: named_tests.sh document directory-of-tests
set -eu
document=$1
tests=$2
names=$(awk '/^## What users of others miss/ { on = 1 } on' "$document" |
  grep -oE '`[A-Z][A-Za-z0-9]*\.[a-z0-9_]+`' | tr -d '`' | sort -u)
[ -n "$names" ] || { echo "no test is named in $document"; exit 1; }
missing=0
for name in $names; do
  grep -rqE "^TEST(_[FP])?\(${name%.*}, ${name#*.}\)" "$tests" --include='*.cpp' || { echo "no test $name"; missing=1; }
done
situations=$(awk '/^## What users of others miss/ { on = 1 } on' "$document" | grep -oE '`(heroes/)?[a-z_]+/[a-z0-9_]+`' |
  tr -d '`' | sort -u)
for name in $situations; do
  grep -q "\"name\": \"${name##*/}\"" "$tests/situations/${name%/*}.json" || { echo "no situation $name"; missing=1; }
done
exit $missing
