#include "physical_values.hpp"

#include "knot_utm/run/run_folder.hpp"

namespace knot_utm {

YAML::Node physical_values(const Method& method) {
  YAML::Node values = YAML::Load(method_file_text(method));
  for (const char* words : {"name", "notes"}) {
    values["material"].remove(words);
    values["machine"]["load_cell"].remove(words);
  }
  return values;
}

}  // namespace knot_utm
