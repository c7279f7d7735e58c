#include "knot_utm/record/sample.hpp"

#include "knot_utm/record/sample_fields.hpp"

namespace knot_utm {

void Sample::state(Archive& archive) {
  visit_sample_fields([&](const auto& field) {
    auto& value = field.of(*this);
    if constexpr (std::is_enum_v<std::remove_reference_t<decltype(value)>>) {
      archive.choice(field.name, value, last_of(value));
    } else {
      archive(value);
    }
  });
}

}  // namespace knot_utm
