#include "knot_utm/ros/method_setup.hpp"

#include <XmlRpcException.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/ros/curve_bag.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/process.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/study/batch.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

/// The override by which a program follows a record instead of its last pull.
std::string following(const std::string& data, const Program& program) {
  const auto pull = std::find_if(program.rbegin(), program.rend(),
                                 [](const ProgramStep& step) { return step.as<PullStep>() != nullptr; });
  if (pull == program.rend())
    throw InvalidInput::sentence("data", "the method cannot follow " + shown(data) +
                                             ": no step of its program is a pull, which it would replace");
  std::string quoted;
  for (const char c : data) quoted += c == '\'' ? "''" : std::string(1, c);
  return "program." + std::to_string(program.rend() - pull - 1) + "={follow: {record: '" + quoted + "'}}";
}

std::vector<std::string> list_of_overrides(const std::string& text) {
  try {
    return YAML::Load("[" + text + "]").as<std::vector<std::string>>();
  } catch (const YAML::Exception&) {
    throw InvalidInput("overrides", text, "'key=value', 'key=value'");
  }
}

}  // namespace

TestWords read_words(const std::function<std::string(const std::string& name)>& word) {
  return {word("method"),
          word("shipped_methods"),
          word("material"),
          word("preload"),
          word("working_directory"),
          word("data"),
          word("bag"),
          word("out"),
          list_of_overrides(word("overrides"))};
}

MethodSetup set_up(const TestWords& words) {
  const fs::path base = words.working_directory.empty() ? fs::current_path() : fs::path(words.working_directory);
  if (words.method.empty())
    throw InvalidInput::missing("method", "a method file, method:=FILE, or the name of a shipped method");
  std::vector<std::string> overrides;
  if (!words.material.empty()) overrides.push_back("material=" + words.material);
  if (!words.preload.empty()) overrides.push_back("specimen.preload=" + words.preload);
  overrides.insert(overrides.end(), words.overrides.begin(), words.overrides.end());

  MethodSetup setup;
  setup.words = words;
  // The launch file knows the package's own methods, wherever the package is installed.
  const std::string file =
      fs::path(find_method(words.method, base.string(), {words.shipped_methods})).lexically_normal().string();
  const auto load = [&] {
    setup.notices.clear();
    const auto tell = [&](const std::string& line) { setup.notices.push_back(line); };
    setup.method = load_test(file, overrides, tell, "overrides:");
  };
  load();
  if (!words.data.empty()) {
    const std::string data = (base / words.data).lexically_normal().string(), curve = curve_file_of(data);
    if (is_curve_file(curve) && !has_travel(read_curve(curve))) {
      setup.beside = curve;
      setup.notices.push_back(curve + ": it has no travel to follow, and is beside the method's own pull");
    } else {
      overrides.push_back(following(data, setup.method.program));
      load();
    }
  } else if (!words.bag.empty()) {
    setup.beside = (base / words.bag).lexically_normal().string();
  }
  if (!setup.beside.empty()) read_record(setup.beside);
  try {  // refused now, and not once the test has begun
    const int count = setup.method.specimens.count;
    if (count > 1)
      throw InvalidInput::sentence("specimens.count",
                                   "specimens.count is " + std::to_string(count) +
                                       ", but under ROS it must be 1: tensile_test and scripts/sweep test several");
    check_fits(setup.method);
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(file);
  }
  // The folder's name below out/.
  const std::string& name = setup.method.name;
  if (name == "." || name == "..")
    throw InvalidInput::sentence("method", "the method file cannot be called \"" + shown(file) +
                                               "\": its name without its ending is that of the folder to write to");
  setup.out = (base / (words.out.empty() ? fs::path("out") / name : fs::path(words.out))).lexically_normal().string();
  return setup;
}

TestWords asked_for(TestWords launched, const StartTest::Request& request) {
  TestWords words = std::move(launched);
  const bool keeps_overrides = request.overrides.empty();
  if (!keeps_overrides) {
    words.overrides = request.overrides;
    words.overrides.erase(std::remove(words.overrides.begin(), words.overrides.end(), ""), words.overrides.end());
  }
  const auto ask = [&](std::string& word, const char* key, const std::string& asked) {
    if (asked.empty()) return;
    word = asked;
    if (keeps_overrides) words.overrides.push_back(key + ("=" + asked));  // behind the launch's: the last one counts
  };
  if (!request.method.empty()) words.method = request.method;
  ask(words.material, "material", request.material);
  ask(words.preload, "specimen.preload", request.preload == 0.0 ? "" : format_yaml_number(request.preload));
  return words;
}

MethodSetup read_test_setup(const ros::NodeHandle& node) {
  return set_up(read_words([&](const std::string& name) {
    std::string text;
    read_parameter(node, "test/" + name, &text, "a text");
    return text;
  }));
}

bool give_order(const ros::NodeHandle& node, const TestOrder& order) {
  XmlRpc::XmlRpcValue value;
  value["name"] = order.method.name;
  value["method"] = method_yaml(order.method);
  value["out"] = order.out;
  value["beside"] = order.beside;
  return set_parameter(node.resolveName(names::kTestOrder), value);
}

TestOrder given_order(const ros::NodeHandle& node) {
  const std::string name = node.resolveName(names::kTestOrder);
  try {
    if (std::optional<XmlRpc::XmlRpcValue> value = ask_master("getParam", {XmlRpc::XmlRpcValue(name)})) {
      const auto text = [&](const char* key) { return static_cast<std::string&>((*value)[key]); };
      return {parse_method(text("method"), text("name") + ".yaml"), text("out"), text("beside")};
    }
  } catch (const XmlRpc::XmlRpcException&) {
    // It is no map of texts.
  }
  throw InvalidInput::sentence(
      name, "cannot read the parameter " + name +
                ", which utm_node sets before each test: it is not there, or the ROS master does not answer");
}

}  // namespace knot_utm
