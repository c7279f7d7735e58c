# Folders that CMake has built in. Sourced.

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
