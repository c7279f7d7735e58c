# What the scripts in bash do with their command line before they set up or build anything. Sourced; it sets `root`, and answers
# --help and -h, wherever they stand, with the comment at the head of the script, and with what more_help prints.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
case " $* " in
  *" --help "* | *" -h "*)
    sed -n '2,$ { /^#/!q; s/^# \{0,1\}//p }' "$0"
    if declare -F more_help >/dev/null; then more_help; fi
    exit 0
    ;;
esac

# Ends the script: its words are wrong.
refuse() {
  echo "scripts/$(basename "$0"): $1 (scripts/$(basename "$0") --help)" >&2
  exit 2
}

# For scripts that have no options.
refuse_options() {
  local word
  for word in "$@"; do
    case $word in -*) refuse "it has no option $word" ;; esac
  done
}

# Becomes a program of the package python/knot_utm, by Debian's Python with Debian's packages: run_module MODULE WORD...
run_module() {
  local module=$1
  exec env -u PYTHONHOME PYTHONPATH="$root/python" OPENBLAS_NUM_THREADS=1 /usr/bin/python3 -sPB -m "knot_utm.$module" "${@:2}"
}

# Installs what is missing, with the packages of one kind (scripts/setup), and builds the targets named: prepare KIND [TARGET...].
# Nothing where KNOT_UTM_SKIP_BUILD is set. What both say goes to stderr: the output of the script is its own.
prepare() {
  if [ -n "${KNOT_UTM_SKIP_BUILD:-}" ]; then return; fi
  declare -g "knot_utm_$1=1"
  . "$root/scripts/setup" >&2
  if [ $# -gt 1 ]; then "$root/scripts/build" "${@:2}" >&2 || exit 1; fi
}

# The files that changed against the last commit, one a line; where none did, those that the last commit changed.
changed_files() {
  local changed
  changed=$({ command git -C "$root" diff --name-only HEAD; command git -C "$root" ls-files --others --exclude-standard; } | sort -u)
  if [ -z "$changed" ]; then changed=$(command git -C "$root" show --name-only --format= HEAD); fi
  echo "$changed"
}

# CMake refuses a folder that was moved or copied, with its sources or without: such a one is taken away, to be built anew.
forget_moved() {
  local folder=$1 sources=$2 cache=$1/CMakeCache.txt was_sources was_folder
  if [ ! -f "$cache" ]; then return 0; fi
  was_sources=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache")
  was_folder=$(sed -n 's/^CMAKE_CACHEFILE_DIR:INTERNAL=//p' "$cache")
  if [ "$was_sources" -ef "$sources" ] && [ "$was_folder" -ef "$folder" ]; then return 0; fi
  echo "$folder was built as $was_folder and then moved or copied: it is built anew"
  rm -rf "$folder"
}
