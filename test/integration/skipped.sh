#!/bin/sh
# scripts/ctest: its list of skipped tests, its last line and its exit code. Usage: skipped.sh SOURCE_DIR SCRATCH
set -eu
rm -rf "$2"
mkdir -p "$2/build"
cd "$2"
cat >CMakePresets.json <<'END'
{"version": 3, "configurePresets": [{"name": "four", "generator": "Ninja", "binaryDir": "${sourceDir}/build"}],
 "testPresets": [{"name": "four", "configurePreset": "four"}]}
END
cat >build/CTestTestfile.cmake <<'END'
add_test(whole sh -c "echo starting; echo whole: no glass; exit 77")
set_tests_properties(whole PROPERTIES SKIP_RETURN_CODE 77)
add_test(part sh -c "for i in 1 2; do echo part: SKIPPED: waves, no water; done; echo SKIPPED: sand; echo part: 3 checks")
add_test(passes true)
add_test(fails sh -c "echo SKIPPED: all, no luck; exit 1")
END
cat >wanted <<'END'
Skipped:
  whole: no glass
  part, in part: waves, no water
  part, in part: sand
  fails, in part: all, no luck

2 passed, 1 failed, 1 skipped, 2 in part
END
! "$1/scripts/ctest" four >printed 2>&1 || { echo "skipped: a failed test is no failure"; exit 1; }
sed -n '/^Skipped:/,$p' printed | diff - wanted
[ "$(sort build/Testing/Temporary/LastTestsSkipped.log | tr '\n' ' ')" = "fails part whole " ]
# what an earlier run skipped is not said again
"$1/scripts/ctest" four -R passes >printed
[ "$(tail -n 1 printed)" = "1 passed, 0 failed, 0 skipped, 0 in part" ]
! grep -q '^Skipped' printed || exit 1
[ ! -s build/Testing/Temporary/LastTestsSkipped.log ]
! "$1/scripts/ctest" four -R none >printed 2>&1 || { echo "skipped: no test is no failure"; exit 1; }
echo "skipped: the list is right"
