// A material's file.
#include "fuzz/memory_file.hpp"
#include "fuzz/target.hpp"
#include "knot_utm/io/method.hpp"

namespace knot_utm {

void fuzz(const std::string& text) {
  const MemoryFile file(text);
  const Method method = parse_method("{material: " + file.name() + ", program: [{hold: {duration: 1}}]}", "fuzz.yaml");
  const Material& material = method.material;
  promise(material.radius >= 1e-5 && material.radius <= 0.05, "a radius in its range");
  promise(material.bending_stiffness > 0.0 && material.stretching_stiffness > 0.0, "stiffnesses above zero");
  promise(!material.name.empty(), "a material has a name");
}

}  // namespace knot_utm
