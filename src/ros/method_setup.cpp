#include "knot_utm/ros/method_setup.hpp"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/this_node.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/raw/raw_zero.hpp"
#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/ros/launched.hpp"
#include "knot_utm/ros/loopback.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/order_of_test.hpp"
#include "knot_utm/run/curve_file.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/study/specimens.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

/// Set by hand, a text that looks like a number is one.
std::string text_parameter(const ros::NodeHandle& node, const std::string& name) {
  XmlRpc::XmlRpcValue value;
  if (!node.getParam(name, value)) return "";
  if (value.getType() == XmlRpc::XmlRpcValue::TypeString) return static_cast<std::string>(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) return std::to_string(static_cast<int>(value));
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", static_cast<double>(value));
    return text;
  }
  throw InvalidInput(node.resolveName(name), "a list or a map", "a text or a number");
}

/// The launch file knows the package's own methods, wherever the package is installed.
std::string method_file(const TestWords& words, const fs::path& base) {
  if (words.method.empty())
    throw InvalidInput::missing("method", "a method file, method:=FILE, or the name of a shipped method");
  return fs::path(find_method(words.method, base.string(), {words.shipped_methods})).lexically_normal().string();
}

/// The override by which a program follows a record instead of its last pull.
std::string following(const std::string& data, const RecordWords& words, const Program& program) {
  const auto pull = std::find_if(program.rbegin(), program.rend(),
                                 [](const ProgramStep& step) { return step.as<PullStep>() != nullptr; });
  if (pull == program.rend())
    throw InvalidInput::sentence(
        "data", data,
        "the method cannot follow " + shown(data) + ": no step of its program is a pull, which it would replace");
  const auto key = [](const char* name, const std::string& value) {
    std::string quoted;
    for (const char c : value) quoted += c == '\'' ? "''" : std::string(1, c);
    return std::string(name) + ": '" + quoted + '\'';
  };
  return "program." + std::to_string(program.rend() - pull - 1) + "={follow: {" + key("record", data) + ", " +
         key("columns", words.columns) + ", " + key("units", words.units) + ", " + key("specimen", words.specimen) +
         ", " + key("invert", words.invert) + "}}";
}

/// A method whose overrides are called what a launch calls them.
Method load(const std::string& file, const std::vector<std::string>& overrides) {
  return load_test(file, overrides, nullptr, "overrides:");
}

/// Reads the record of the words. Where it cannot be read, that is said in the words of a launch.
void read_record(const fs::path& base, MethodSetup& setup) {
  const TestWords& words = setup.words;
  const RawSpelling spelling{"", ":=", false};
  const RawOptions options = raw_options(words.record, spelling);
  const std::string given = (base / words.data).lexically_normal().string();
  setup.data = curve_file_of(given, options);
  setup.record = read_course(setup.data, options, [&](const std::string& line) { setup.told.push_back(line); });
  const std::string unused = without_effect(words.record, spelling, setup.data != given);
  if (!unused.empty() && has_its_zero(setup.record))
    setup.told.push_back(setup.data + ": the curve is one of knot_utm, for which " + unused);
}

/// Refused now, and not once others have been tested.
void check_specimens(const Method& method) {
  const int count = method.specimens.count;
  if (count == 1) return check_fits(method);
  if (count > kMostInBatch)
    throw InvalidInput::sentence("specimens.count", std::to_string(count),
                                 "specimens.count is " + std::to_string(count) + ", but under ROS it may be at most " +
                                     std::to_string(kMostInBatch) + "; tensile_test takes more");
  draw_specimens(method);
}

/// utm_node reads the same where it is launched too, which its parameters tell.
bool another_says_it(const ros::NodeHandle& node) {
  return ros::this_node::getName() != node.resolveName(names::kUtmNode) &&
         node.hasParam(std::string(names::kUtmNode) + "/exit_at_end");
}

TestWords read_words(const ros::NodeHandle& node) {
  TestWords words;
  words.method = text_parameter(node, "test/method");
  words.shipped_methods = text_parameter(node, "test/shipped_methods");
  words.material = text_parameter(node, "test/material");
  words.preload = text_parameter(node, "test/preload");
  words.working_directory = text_parameter(node, "test/working_directory");
  words.data = text_parameter(node, "test/data");
  words.record = {text_parameter(node, "test/columns"), text_parameter(node, "test/units"),
                  text_parameter(node, "test/specimen"), text_parameter(node, "test/invert")};
  words.out = text_parameter(node, "test/out");
  read_parameter(node, "test/overrides", &words.overrides, "a list of texts");
  return words;
}

/// Without the overrides of this very key, which one that is given in another way would else not replace.
void remove_overrides(std::vector<std::string>& overrides, const std::string& key) {
  const auto is_of_key = [&](const std::string& override_) { return override_.rfind(key + "=", 0) == 0; };
  overrides.erase(std::remove_if(overrides.begin(), overrides.end(), is_of_key), overrides.end());
}

MethodSetup read_parameters(const ros::NodeHandle& node) {
  MethodSetup setup = set_up(read_words(node));
  if (another_says_it(node)) return setup;
  try {
    check_specimens(setup.method);
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(setup.file);
  }
  return setup;
}

/// Prints one line on the console, whether or not ROS logging is available. Returns `code`.
int report_failure(const char* name, const char* what, int code) {
  std::fprintf(stderr, "%s: %s\n", name, what);
  return code;
}

}  // namespace

MethodSetup set_up(const TestWords& words) {
  const fs::path base = words.working_directory.empty() ? fs::current_path() : fs::path(words.working_directory);
  std::vector<std::string> overrides;
  if (!words.material.empty()) overrides.push_back("material=" + words.material);
  if (!words.preload.empty()) overrides.push_back("specimen.preload=" + words.preload);
  overrides.insert(overrides.end(), words.overrides.begin(), words.overrides.end());

  MethodSetup setup;
  setup.words = words;
  setup.file = method_file(words, base);
  setup.method = load(setup.file, overrides);
  if (!words.data.empty()) {
    read_record(base, setup);
    overrides.push_back(following(setup.data, words.record, setup.method.program));
    setup.method = load(setup.file, overrides);
  }
  // The folder's name below out/.
  const std::string& name = setup.method.name;
  if (name == "." || name == "..") {
    throw InvalidInput::sentence("method", setup.file,
                                 "the method file cannot be called \"" + shown(setup.file) +
                                     "\": its name without its ending is that of the folder to write to");
  }
  setup.out = (base / (words.out.empty() ? fs::path("out") / name : fs::path(words.out))).lexically_normal().string();
  return setup;
}

TestWords asked_for(TestWords launched, const StartTest::Request& request) {
  TestWords words = std::move(launched);
  if (!request.method.empty()) words.method = request.method;
  if (!request.overrides.empty()) {
    words.overrides = request.overrides;
    words.overrides.erase(std::remove(words.overrides.begin(), words.overrides.end(), ""), words.overrides.end());
  }
  const bool keeps_overrides = request.overrides.empty();
  if (!request.material.empty()) {
    words.material = request.material;
    if (keeps_overrides) remove_overrides(words.overrides, "material");
  }
  if (request.preload != 0.0) {
    words.preload = format_yaml_number(request.preload);
    if (keeps_overrides) remove_overrides(words.overrides, "specimen.preload");
  }
  return words;
}

MethodSetup read_test_setup(const ros::NodeHandle& node) {
  try {
    return read_parameters(node);
  } catch (const InvalidInput& invalid) {
    if (another_says_it(node)) throw SaidByAnother(invalid);
    throw;
  }
}

ros::NodeHandle join_ros(int argc, char** argv, const char* name) {
  prefer_loopback();
  ros::init(argc, argv, name);
  ros::start();  // so that it goes on until `leave_ros`, and not until the last handle is gone
  end_with_launch();
  const ros::NodeHandle node;
  bool network = false;
  read_parameter(node, "test/network", &network, "true or false");
  if (!network) {
    stay_on_loopback();
  } else if (name == std::string(names::kUtmNode)) {  // one of all that say it
    ROS_WARN("network:=true: ROS 1 has no authentication, so anyone who reaches this machine can command the test");
  }
  return node;
}

std::optional<int> answer_words(int argc, char** argv, const char* name, const char* help) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.find(":=") != std::string::npos) continue;
    if (word == "--version") {
      std::puts(version().c_str());
      return 0;
    }
    if (word == "--help" || word == "-h") {
      std::printf("usage: rosrun knot_utm %s [NAME:=VALUE]...\n\n%s", name, help);
      return 0;
    }
    return report_failure(name, ("it takes no \"" + shown(word) + "\" (" + name + " --help)").c_str(), 2);
  }
  return std::nullopt;
}

int run_node(int argc, char** argv, const char* name, const char* help, const std::function<int()>& body) {
  if (const std::optional<int> answered = answer_words(argc, argv, name, help)) return *answered;
  int code = 0;
  try {
    code = body();
  } catch (const SaidByAnother&) {
    wait_for_end_of(names::kUtmNode);
    code = 2;
  } catch (const InvalidInput& error) {
    code = report_failure(name, error.what(), 2);
    end_launch();
  } catch (const std::exception& error) {
    code = report_failure(name, error.what(), 1);
    end_launch();
  }
  if (ros::isStarted()) ros::shutdown();
  return code;
}

}  // namespace knot_utm
