// What libFuzzer and replay.cpp call: first with the command line, whose --target=NAME says which parser is meant, then
// with every input.
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "fuzz/target.hpp"

namespace {

std::map<std::string, knot_utm::FuzzTarget::Fuzz>& targets() {
  static std::map<std::string, knot_utm::FuzzTarget::Fuzz> all;
  return all;
}

knot_utm::FuzzTarget::Fuzz chosen = nullptr;

}  // namespace

knot_utm::FuzzTarget::FuzzTarget(const std::string& name, Fuzz fuzz) { targets()[name] = fuzz; }

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string option = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string word = (*argv)[i];
    if (word.compare(0, option.size(), option) != 0) continue;
    const auto found = targets().find(word.substr(option.size()));
    if (found != targets().end()) chosen = found->second;
  }
  knot_utm::promise(chosen != nullptr, "--target=NAME names a target");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  knot_utm::understood([&] { chosen(std::string(data, data + size)); });
  return 0;
}
