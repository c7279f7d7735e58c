#include "physical_values.hpp"

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"

namespace knot_utm {

YAML::Node physical_values(const Method& method) {
  YAML::Node values = YAML::Load(method_file_text(method));
  for (const char* words : {"name", "notes"}) {
    values["material"].remove(words);
    if (method.material.other) values["other_material"].remove(words);
    values["machine"]["load_cell"].remove(words);
  }
  // What a knot's file says, whatever it is called.
  if (method.specimen.drawing) values["specimen"]["knot"] = method.specimen.drawing->text;
  return values;
}

}  // namespace knot_utm
