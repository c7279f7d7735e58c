# What the scripts in bash do with their command line before they set up or build anything. Sourced.

# Answers --help and -h, wherever they stand, with the comment at the head of the script, and ends it.
answer_help() {
  local word
  for word in "$@"; do
    case $word in
      -h | --help)
        sed -n '2,$ { /^#/!q; s/^# \{0,1\}//p }' "$0"
        if declare -F more_help >/dev/null; then more_help; fi
        exit 0
        ;;
    esac
  done
}

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
