#!/usr/bin/env bash
# Sets up this checkout as a catkin workspace, builds it, tests it, shows it.
#
#   catkin_ws_setup.sh deps      installs the packages that are missing (apt-get, as root or by sudo): Debian 11 to 13,
#                                Ubuntu 20.04 (its own ROS packages or those in /opt/ros/noetic)
#   catkin_ws_setup.sh build     deps, catkin_make: this checkout is base and source space of the workspace
#   catkin_ws_setup.sh test      build, then all unit tests and rostests; --long adds those that take minutes
#   catkin_ws_setup.sh demo      build, then from simulated logs of four data sets to a scored run and a report
#   catkin_ws_setup.sh clean     removes what the others made in this checkout
#   catkin_ws_setup.sh help      prints this text
#
# Every subcommand does what it needs before itself and can be repeated. Warnings are errors with
# PCRB_WERROR=ON; JOBS=N sets the number of parallel compilers; CMAKE_ARGS has further arguments of cmake.
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd -P)
python=/usr/bin/python3

needed_debian_packages=(
  catkin ccache cmake g++ make pkg-config
  libros-rosgraph-msgs-dev librosbag-dev librostest-dev libstd-srvs-dev libtf2-dev libtf2-msgs-dev
  libtf2-ros-dev libtopic-tools-dev libvisualization-msgs-dev libxmlrpcpp-dev ros-base-dev rosbash rviz
  python3-dev python3-geometry-msgs python3-jinja2 python3-matplotlib python3-nav-msgs python3-numpy
  python3-pil python3-pytest python3-rosbag python3-rosgraph-msgs python3-rosnode python3-rospy python3-rostest
  python3-sensor-msgs python3-std-msgs python3-std-srvs python3-tf2-msgs python3-tf2-ros
  python3-visualization-msgs python3-yaml
  libarchive-dev libbenchmark-dev libboost-dev libcli11-dev libcurl4-openssl-dev libeigen3-dev libgtest-dev
  liblzf-dev libnanoflann-dev libpcl-dev libpng-dev libsodium-dev libsqlite3-dev libtinyxml2-dev libyaml-cpp-dev
  nlohmann-json3-dev pybind11-dev
)
# What the ROS packages among them are called in ROS Noetic's own repository: ros-noetic-NAME.
declare -A noetic_names=(
  [catkin]=catkin [ros-base-dev]=ros-base [rosbash]=rosbash [rviz]=rviz
  [libros-rosgraph-msgs-dev]=rosgraph-msgs [librosbag-dev]=rosbag [librostest-dev]=rostest
  [libstd-srvs-dev]=std-srvs [libtf2-dev]=tf2 [libtf2-msgs-dev]=tf2-msgs [libtf2-ros-dev]=tf2-ros
  [libtopic-tools-dev]=topic-tools [libvisualization-msgs-dev]=visualization-msgs [libxmlrpcpp-dev]=xmlrpcpp
  [python3-geometry-msgs]=geometry-msgs [python3-nav-msgs]=nav-msgs [python3-rosbag]=rosbag
  [python3-rosgraph-msgs]=rosgraph-msgs [python3-rosnode]=rosnode [python3-rospy]=rospy [python3-rostest]=rostest
  [python3-sensor-msgs]=sensor-msgs [python3-std-msgs]=std-msgs [python3-std-srvs]=std-srvs
  [python3-tf2-msgs]=tf2-msgs [python3-tf2-ros]=tf2-ros [python3-visualization-msgs]=visualization-msgs
)
# Only .ci/run asks for these: catkin_ws_setup.sh deps --ci
ci_debian_packages=(catkin-lint chromium clang clang-format clang-tidy debootstrap iproute2 libclang-rt-14-dev locales munge
  doxygen python3-pip python3-setuptools python3-wheel shellcheck slurm-wlm texlive-latex-recommended xvfb zsh)

say() { printf '==> %s\n' "$*"; }

fail() {
  printf 'catkin_ws_setup.sh: %s\n' "$*" >&2
  exit 1
}

usage() { sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"; }

# --- deps -------------------------------------------------------------------------------------------

# Which ROS 1 this machine has: `debian` (the distribution's own packages), `noetic` (/opt/ros/noetic) or `sourced`
# (another one, in the environment of this shell); nothing where there is none.
ros_kind() {
  local tool
  tool=$(command -v catkin_make) || true
  if [[ -n "${ROS_DISTRO:-}" && -n "$tool" && "$tool" != /usr/bin/* && "$tool" != /bin/* && "$tool" != /opt/ros/noetic/* ]]; then
    echo sourced
  elif [ -e /opt/ros/noetic/setup.bash ]; then
    echo noetic
  elif grep -qsEx 'ID=(debian|ubuntu)' /etc/os-release && grep -qsEx 'VERSION_ID="(1[123]|20\.04)"' /etc/os-release; then
    echo debian
  fi
}

# The packages of the list by their names here, one a line.
names_of_packages() {
  local kind=$1 package
  shift
  for package in "$@"; do
    if [ "$kind" = debian ]; then
      echo "$package"
    elif [ -n "${noetic_names[$package]:-}" ]; then
      if [ "$kind" = noetic ]; then echo "ros-noetic-${noetic_names[$package]}"; fi
    else
      echo "$package"
    fi
  done | sort -u
}

# CMake fetches some small libraries where apt does not know them (docs/platforms.md).
without_fetched_libraries() {
  local package
  while read -r package; do
    case $package in
      libcli11-dev | liblzf-dev | libnanoflann-dev) if ! apt-cache show "$package" >/dev/null 2>&1; then continue; fi ;;
    esac
    echo "$package"
  done
}

missing_debian_packages() {
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

# apt-get as root, tried once more after a failure: mirrors and locks have bad moments.
apt_get() {
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "installing packages needs root or sudo"
    as_root=(sudo)
  fi
  local command=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get -q -o DPkg::Lock::Timeout=300 "$@")
  "${command[@]}" || {
    say "apt-get $1 failed, one more try"
    "${command[@]}"
  }
}

# Installs the packages of the list that are missing; with a ROS of the user's own those that are not ROS.
install_dependencies() {
  local kind names missing
  kind=$(ros_kind)
  [ -n "$kind" ] || fail "found no ROS 1 for $(sed -n 's/^PRETTY_NAME=//p' /etc/os-release): source one, or use" \
    "Debian 11 to 13, Ubuntu 20.04 with ros-noetic-ros-base, or docker/Dockerfile"
  if ! command -v dpkg-query >/dev/null; then
    say "deps: no Debian packages here; where the build misses a library, its name is in needed_debian_packages"
    return
  fi
  mapfile -t names < <(names_of_packages "$kind" "$@")
  mapfile -t missing < <(missing_debian_packages "${names[@]}" | without_fetched_libraries)
  if [ ${#missing[@]} = 0 ]; then
    say "deps: all packages are installed (ROS: $kind)"
    return
  fi
  say "deps: installing ${missing[*]}"
  apt_get update || fail "apt-get update failed twice (is there a network?)"
  # Only now does apt know all names.
  mapfile -t missing < <(missing_debian_packages "${names[@]}" | without_fetched_libraries)
  apt_get install -y --no-install-recommends "${missing[@]}" ||
    fail "apt-get could not install: ${missing[*]}"
}

# --- build ------------------------------------------------------------------------------------------

# A build space that was made elsewhere (a moved or copied checkout) is of no use here.
drop_foreign_build_space() {
  local cache=$root/build/CMakeCache.txt
  if [ -e "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    say "remove build/ and devel/, which were made in another folder"
    rm -rf "$root/build" "$root/devel"
  fi
}

# What is made here is never searched for packages: neither here, where the whole checkout is the source space,
# nor in a workspace whose src/ this tree is copied into.
hide_products() {
  local folder
  for folder in build devel install demo; do
    mkdir -p "$root/$folder"
    touch "$root/$folder/CATKIN_IGNORE"
  done
}

# One compiler takes up to 2 GB, because of PCL's headers.
parallel_jobs() {
  local by_memory by_processors
  by_memory=$(awk '/^MemAvailable:/ {print int($2 / 2000000)}' /proc/meminfo)
  by_processors=$(nproc)
  if [ "$by_memory" -lt 1 ]; then by_memory=1; fi
  echo "${JOBS:-$((by_memory < by_processors ? by_memory : by_processors))}"
}

# The system's ROS and the system's Python before conda's and pyenv's, but for a ROS that the caller has sourced.
set_environment() {
  export PYTHONNOUSERSITE=1 ROS_IP=127.0.0.1 ROS_HOME=$root/build/ros_home
  unset ROS_HOSTNAME
  if [ ! -d "${TMPDIR:-/tmp}" ]; then
    say "TMPDIR ($TMPDIR) does not exist: using /tmp"
    unset TMPDIR
  fi
  case $(ros_kind) in
    sourced) python=$(command -v python3) ;;
    noetic)
      if [ "${ROS_DISTRO:-}" != noetic ]; then
        set +u
        # shellcheck source=/dev/null
        . /opt/ros/noetic/setup.bash
        set -u
      fi
      export PATH=/opt/ros/noetic/bin:/usr/bin:$PATH
      ;;
    *)
      export PATH=/usr/bin:$PATH
      if [ "${ROS_DISTRO:-Debian}" != Debian ]; then unset ROS_DISTRO; fi
      ;;
  esac
}

run_catkin_make() {
  local forced=()
  # The catkin of Debian 11 keeps in CMake's cache that googletest is there, and then makes no targets of it when CMake runs again,
  # which make may want at any time.
  if grep -q '^GMOCK_FOUND:' "$root/build/CMakeCache.txt" 2>/dev/null; then forced=(--force-cmake); fi
  # shellcheck disable=SC2086 # several arguments
  catkin_make -C "$root" --source "$root" "-j${parallel:-$(parallel_jobs)}" "${forced[@]}" "$@" --cmake-args -Wno-dev -UGMOCK_FOUND \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "-DPYTHON_EXECUTABLE=$python" "-DPCRB_WERROR=${PCRB_WERROR:-OFF}" ${CMAKE_ARGS:-}
}

build_workspace() {
  case $root in *[[:space:]]*) fail "catkin cannot build in a folder with spaces in its path: $root" ;; esac
  [ -w "$root" ] || fail "cannot write to $root"
  install_dependencies "${needed_debian_packages[@]}"
  set_environment
  drop_foreign_build_space
  hide_products
  say "build: catkin_make in $root"
  run_catkin_make || fail "the build failed, see above"
  say "built; to use it: source $root/devel/setup.bash"
}

# --- test -------------------------------------------------------------------------------------------

test_workspace() {
  build_workspace
  if [ "${1:-}" = --long ]; then export PCRB_LONG_TESTS=1; fi
  rm -rf "$root/build/test_results"
  mkdir -p "$root/build/test_results"
  say "test: unit tests and rostests"
  run_catkin_make tests || fail "the tests could not be built, see above"
  # A rostest waits for most of its time, and each has a master of its own.
  parallel=$((2 * $(parallel_jobs))) run_catkin_make run_tests || fail "the tests could not be run, see above"
  "$python" "$root/.ci/count_tests.py" "$root/build/test_results"
}

# --- demo -------------------------------------------------------------------------------------------

show_demo() {
  build_workspace
  # Its log stays, by which the folder is known for a demo's, and so does what somebody else put there.
  rm -rf "$root"/demo/{logs,data,run,paper}
  hide_products
  set +u
  # shellcheck source=/dev/null
  . "$root/devel/setup.bash"
  set -u
  pcrb demo --output "$root/demo" || fail "the demo did not finish, see above"
}

# --- clean ------------------------------------------------------------------------------------------

clean_workspace() {
  say "clean: remove build/ devel/ install/ demo/ and what catkin_make puts beside them"
  if [ -L "$root/CMakeLists.txt" ]; then rm "$root/CMakeLists.txt"; fi
  rm -rf "$root/build" "$root/devel" "$root/install" "$root/demo" "$root/.catkin_workspace"
}

main() {
  case "${1:-help} ${2:-}" in
    "deps ") install_dependencies "${needed_debian_packages[@]}" ;;
    "deps --ci") install_dependencies "${needed_debian_packages[@]}" "${ci_debian_packages[@]}" ;;
    "build ") build_workspace ;;
    "test " | "test --long") test_workspace "${2:-}" ;;
    "demo ") show_demo ;;
    "clean ") clean_workspace ;;
    "help " | "--help " | "-h ") usage ;;
    *)
      usage >&2
      fail "unknown: $*"
      ;;
  esac
}

main "$@"
