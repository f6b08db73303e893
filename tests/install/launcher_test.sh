#!/bin/bash
# The launcher in a tree of its own, with stand-ins for everything that would install, build or test. Each stand-in
# writes its call to $calls.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
export calls=$tree/calls installed=$tree/installed tree
unset CI THINWALL_YES THINWALL_DRY_RUN

stand_in() {  # name, body
  printf '#!/bin/bash\n%s\n' "$2" >"$tree/bin/$1"
  chmod +x "$tree/bin/$1"
}

# The stand-ins expand their variables when they run.
# shellcheck disable=SC2016
set_up() {
  rm -rf "${tree:?}"/*
  mkdir -p "$tree/bin" "$tree"/{core,dynamics,linalg,mesh,fem,reduction,robot,coupling,regression,identification,milling,learning,posture,io,setup,case,study,report,web/dist,app,cmake}
  touch "$calls" "$installed" "$tree"/{CMakeLists.txt,CMakePresets.json,web/template.html} "$tree"/core/{error,interrupt}.hpp
  cp "$here/../../thinwall" "$here/../../packages.txt" "$tree"
  stand_in dpkg-query 'grep -qx "${@: -1}" "$installed" && printf installed'
  stand_in id 'echo "${uid:-0}"'
  stand_in sudo 'echo "sudo $*" >>"$calls"; "$@"'
  stand_in apt-get 'echo "apt-get $*" >>"$calls"; [[ -z ${no_network:-} ]] || exit 100
    for word; do printf "%s\n" "$word" >>"$installed"; done'
  stand_in cmake 'echo "cmake $*" >>"$calls"; [[ -z ${broken:-} ]] || exit 1
    if [[ $* == *package* ]]; then mkdir -p build/package/packages; touch build/package/{build.ninja,packages/a.deb,packages/b.deb}; exit; fi
    mkdir -p build/release/app; touch build/release/build.ninja; cp "$tree/bin/program" build/release/app/thinwall'
  stand_in ctest 'echo "ctest $*" >>"$calls"; exit 8'
  stand_in program 'printf "<%s>" "$@"; exit "${program_exit:-0}"'
}

packages() { awk '$1 !~ /^#/ && $2 == "build" { print $1 }' "$tree/packages.txt"; }

# Runs the launcher without a terminal; out, messages and code tell what came of it.
launch() {
  code=0
  : >"$calls"
  out=$(PATH="$tree/bin:$PATH" "$tree/thinwall" "$@" 2>"$tree/messages" </dev/null) || code=$?
  messages=$(<"$tree/messages")
  called=$(<"$calls")
}

age_build() { find "$tree" -exec touch -d '1 minute ago' {} +; touch -d "30 seconds ago" "$tree/build/release/.thinwall-built"; }

# --- a bare machine, asked for its plan only
set_up
THINWALL_DRY_RUN=1 launch run "my case"
expect_equal "the plan's exit code" 0 "$code"
expect_equal "the plan" "install $(packages | xargs)
build thinwall
$tree/build/release/app/thinwall run my case" "$out"
expect_equal "a plan does nothing" "" "$called"
expect_equal "a plan leaves nothing" "no" "$([[ -e $tree/build ]] && echo yes || echo no)"

# --- nobody can be asked
launch run case
expect_equal "refused without consent" 2 "$code"
expect_contains "says how to consent" "THINWALL_YES=1" "$messages"
expect_contains "says what it would install" "libtet1.5-dev" "$messages"
expect_equal "nothing called without consent" "" "$called"

# --- consent, as root: install, configure, build, run
program_exit=6 CI=true launch run "my case"
expect_equal "the program's exit code" 6 "$code"
expect_equal "the program's words, and nothing else, on stdout" "<run><my case>" "$out"
expect_contains "package lists first" "apt-get update" "$called"
expect_contains "installs" "apt-get install -y --no-install-recommends $(packages | head -1)" "$called"
expect_contains "configures" "cmake --preset release" "$called"
expect_contains "builds the program only" "--target thinwall" "$called"
expect_equal "no sudo for root" "" "$(grep sudo <<<"$called" || true)"

# --- the second time it starts at once
age_build
launch run case
expect_equal "second start" "<run><case>" "$out"
expect_equal "second start calls nothing" "" "$called"
expect_equal "second start says nothing" "" "$messages"

# --- a source changes, one disappears
touch "$tree/core/error.hpp"
launch doctor
expect_equal "a changed source is built, not configured again" 1 "$(grep -c cmake <<<"$called")"
age_build
rm "$tree/core/interrupt.hpp"
launch doctor
expect_contains "a removed source is noticed" "cmake --build" "$called"

# --- a build that fails is no build
touch "$tree/core/error.hpp"
broken=1 launch doctor
expect_equal "a failed build" 1 "$code"
expect_contains "a failed build says so" "the build failed" "$messages"
launch doctor
expect_contains "and is tried again" "cmake --build" "$called"

# --- a case with a STEP file is offered its reader, once
mkdir -p "$tree/bracket" "$tree/plain"
printf '[part]\nfile = "bracket.STEP"  # in mm\n' >"$tree/bracket/case.toml"
printf '[part]\nfile = "bracket.stl"  # was bracket.step\n' >"$tree/plain/case.toml"
age_build
reader=libocct-data-exchange-dev
THINWALL_DRY_RUN=1 launch run "$tree/bracket"
expect_contains "the plan has the reader" "install $reader" "$out"
launch run "$tree/bracket"
expect_equal "where nobody can be asked the program runs without it" "<run><$tree/bracket>" "$out"
expect_equal "and nothing is called" "" "$called"
THINWALL_YES=1 launch run "$tree/plain"
expect_equal "another case is offered nothing" "" "$called"
THINWALL_YES=1 launch run "$tree/bracket/case.toml"
expect_contains "the reader is installed" "apt-get install -y --no-install-recommends $reader" "$called"
expect_contains "the build is configured anew" "cmake --preset release" "$called"
expect_contains "and built" "--target thinwall" "$called"
age_build
THINWALL_YES=1 launch run "$tree/bracket"
expect_equal "once" "" "$called"

# --- tests
launch test -R Lobes
expect_equal "ctest's exit code" 8 "$code"
expect_contains "everything is built for the tests" "--target all" "$called"
expect_contains "ctest's words" "ctest --preset release -R Lobes" "$called"

# --- Debian packages
THINWALL_DRY_RUN=1 launch install
expect_equal "the plan of an installation" "install dpkg-dev
make packages in build/package/packages, install them" "$out"
echo dpkg-dev >>"$installed"
launch install now
expect_equal "install takes no words" 2 "$code"
expect_equal "and does nothing then" "" "$called"
mkdir -p "$tree/build/package/packages"
touch "$tree/build/package/packages/old.deb"
launch install
expect_equal "installation's exit code" 0 "$code"
expect_contains "packages are configured" "cmake --preset package" "$called"
expect_contains "packages are made" "cmake --build --preset package" "$called"
packed=$tree/build/package/packages
expect_contains "all that were made now are installed" \
  "apt-get install -y --no-install-recommends $packed/a.deb $packed/b.deb" "$called"
expect_equal "and told" "$packed/a.deb $packed/b.deb" "$(xargs <<<"$out")"
launch install
expect_equal "they are configured once" "" "$(grep -- '--preset package$' <<<"$called" | grep -v build || true)"
broken=1 launch install
expect_equal "packages that cannot be made" 1 "$code"
expect_equal "are not installed" "" "$(grep apt-get <<<"$called" || true)"

# --- not root, then without network
set_up
uid=1000 THINWALL_YES=1 launch doctor
expect_contains "sudo where it is needed" "sudo apt-get update" "$called"
expect_equal "sudo for apt-get only" "" "$(grep '^sudo' <<<"$called" | grep -v apt-get || true)"
set_up
no_network=1 THINWALL_YES=1 launch doctor
expect_equal "no network" 1 "$code"
expect_contains "no network is told" "apt-get update failed" "$messages"
expect_equal "no build without packages" "" "$(grep cmake <<<"$called" || true)"

# --- the scripts themselves, and the list of packages in the docs
root=$here/../..
for script in "$root/thinwall" "$root/.ci/run" "$here"/*.sh; do
  expect_equal "bash -n $(basename "$script")" "" "$(bash -n "$script" 2>&1)"
done
for package in $(packages); do
  expect_contains "docs/dependencies.md names the package" "\`$package\`" "$(<"$root/docs/dependencies.md")"
done
finish
