# The environment of the built package, for scripts that run nodes: source_environment BUILD_FOLDER. Sourced.
source_environment() {
  local folder=$1 flags=$-
  shift  # catkin's script reads arguments
  set +eu  # and allows neither
  . "$folder/devel/setup.bash"
  case $flags in *e*) set -e ;; esac
  case $flags in *u*) set -u ;; esac
}
