#include "knot_utm/ros/method_setup.hpp"

#include <XmlRpcException.h>
#include <ros/console.h>
#include <ros/init.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/ros/ask_master.hpp"
#include "knot_utm/ros/launched.hpp"
#include "knot_utm/ros/loopback.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/study/batch.hpp"
#include "knot_utm/verdict/run_facts.hpp"
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

/// Without the overrides of this very key, which one that is given in another way would else not replace.
void remove_overrides(std::vector<std::string>& overrides, const std::string& key) {
  const auto is_of_key = [&](const std::string& override_) { return override_.rfind(key + "=", 0) == 0; };
  overrides.erase(std::remove_if(overrides.begin(), overrides.end(), is_of_key), overrides.end());
}

/// Refused now, and not once the test has begun.
void check_specimen(const Method& method) {
  const std::string count = std::to_string(method.specimens.count);
  if (method.specimens.count > 1)
    throw InvalidInput::sentence(
        "specimens.count",
        "specimens.count is " + count + ", but under ROS it must be 1: tensile_test and scripts/sweep test several");
  check_fits(method);
}

/// Prints one line on the console, whether or not ROS logging is available. Returns `code`.
int report_failure(const char* name, const std::string& what, int code) {
  std::fprintf(stderr, "%s: %s\n", name, what.c_str());
  return code;
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
    return report_failure(name, "it takes no \"" + shown(word) + "\" (" + name + " --help)", 2);
  }
  return std::nullopt;
}

}  // namespace

TestWords read_words(const std::function<std::string(const std::string& name)>& word) {
  return {word("method"),
          word("shipped_methods"),
          word("material"),
          word("preload"),
          word("working_directory"),
          word("data"),
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
  setup.file = fs::path(find_method(words.method, base.string(), {words.shipped_methods})).lexically_normal().string();
  const auto load = [&] {
    setup.told.clear();
    const auto tell = [&](const std::string& line) { setup.told.push_back(line); };
    setup.method = load_test(setup.file, overrides, tell, "overrides:");
  };
  load();
  if (!words.data.empty()) {
    overrides.push_back(following((base / words.data).lexically_normal().string(), setup.method.program));
    load();
  }
  try {
    check_specimen(setup.method);
  } catch (const InvalidInput& invalid) {
    throw invalid.in_file(setup.file);
  }
  // The folder's name below out/.
  const std::string& name = setup.method.name;
  if (name == "." || name == "..")
    throw InvalidInput::sentence("method", "the method file cannot be called \"" + shown(setup.file) +
                                               "\": its name without its ending is that of the folder to write to");
  setup.out = (base / (words.out.empty() ? fs::path("out") / name : fs::path(words.out))).lexically_normal().string();
  return setup;
}

TestWords asked_for(TestWords launched, const StartTest::Request& request) {
  TestWords words = std::move(launched);
  const bool keeps_overrides = request.overrides.empty();
  if (!request.method.empty()) words.method = request.method;
  if (!keeps_overrides) {
    words.overrides = request.overrides;
    words.overrides.erase(std::remove(words.overrides.begin(), words.overrides.end(), ""), words.overrides.end());
  }
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
  return set_up(read_words([&](const std::string& name) {
    std::string text;
    read_parameter(node, "test/" + name, &text, "a text");
    return text;
  }));
}

TestOrder order_of(const Method& method, const std::string& out) { return {method.name, method_yaml(method), out}; }

Method method_of(const TestOrder& order) { return parse_method(order.method, order.name + ".yaml"); }

bool give_order(const ros::NodeHandle& node, const TestOrder& order) {
  XmlRpc::XmlRpcValue value;
  value["name"] = order.name;
  value["method"] = order.method;
  value["out"] = order.out;
  return ask_master("setParam", {XmlRpc::XmlRpcValue(node.resolveName(names::kTestOrder)), value}).has_value();
}

TestOrder given_order(const ros::NodeHandle& node) {
  const std::string name = node.resolveName(names::kTestOrder);
  try {
    if (std::optional<XmlRpc::XmlRpcValue> value = ask_master("getParam", {XmlRpc::XmlRpcValue(name)}))
      return {static_cast<std::string&>((*value)["name"]), static_cast<std::string&>((*value)["method"]),
              static_cast<std::string&>((*value)["out"])};
  } catch (const XmlRpc::XmlRpcException&) {
    // It is no map of texts.
  }
  throw InvalidInput::sentence(
      name, "cannot read the parameter " + name +
                ", which utm_node sets before each test: it is not there, or the ROS master does not answer");
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

int run_node(int argc, char** argv, const char* name, const char* help, const std::function<int()>& body) {
  if (const std::optional<int> answered = answer_words(argc, argv, name, help)) return *answered;
  int code = 0;
  try {
    code = body();
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
