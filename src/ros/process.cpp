#include "knot_utm/ros/process.hpp"

#include <XmlRpcClient.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "knot_utm/ros/names.hpp"
#include "knot_utm/verdict/run_facts.hpp"

namespace knot_utm {
namespace {

using XmlRpc::XmlRpcValue;

constexpr double kLookAtLaunch = 0.2;  // wall time between two looks at the launch [s]

/// Prints one line on the console, whether or not ROS logging is available. Returns `code`.
int report_failure(const char* name, const std::string& what, int code) {
  std::fprintf(stderr, "%s: %s\n", name, what.c_str());
  return code;
}

/// The exit code where a word of the command line is not for ROS; empty: all are.
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

bool launched() {
  std::ifstream file("/proc/" + std::to_string(getppid()) + "/cmdline");
  for (std::string word; std::getline(file, word, '\0');)
    if (word == "roslaunch" || word.find("/roslaunch") != std::string::npos) return true;
  return false;
}

/// Lets only this machine reach the sockets that this process listens on: roscpp's XML-RPC server listens on every
/// address, whatever ROS_HOSTNAME says, and ROS 1 has no authentication.
void stay_on_loopback() {
  constexpr char kLoopbackDevice[] = "lo";
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int fd = std::atoi(entry.path().filename().c_str());
    int listens = 0;
    socklen_t length = sizeof listens;
    if (getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &length) != 0 || listens == 0) continue;
    if (setsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, kLoopbackDevice, sizeof kLoopbackDevice) != 0)
      throw InvalidInput::sentence("network", "this node cannot be kept from other machines (" + reason_of(errno) +
                                                  "), and ROS 1 has no authentication: allow it by network:=true");
  }
}

void wait() { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLookAtLaunch)); }

}  // namespace

int run_node(int argc, char** argv, const char* name, const char* help, const std::function<int()>& body) {
  if (const std::optional<int> answered = answer_words(argc, argv, name, help)) return *answered;
  int code = 0;
  try {
    code = body();
  } catch (const std::exception& error) {
    code = report_failure(name, error.what(), dynamic_cast<const InvalidInput*>(&error) ? 2 : 1);
    end_launch();
  }
  if (ros::isStarted()) ros::shutdown();
  return code;
}

ros::NodeHandle join_ros(int argc, char** argv, const char* name) {
  if (std::getenv("ROS_HOSTNAME") == nullptr && std::getenv("ROS_IP") == nullptr)
    setenv("ROS_HOSTNAME", "localhost", 1);  // so it names itself to others
  ros::init(argc, argv, name);
  ros::start();  // so that it goes on until run_node ends it, and not until the last handle is gone
  if (launched()) prctl(PR_SET_PDEATHSIG, SIGINT);
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

std::optional<XmlRpcValue> ask_master(const char* call, const std::vector<XmlRpcValue>& words) {
  constexpr int kTries = 3;         // on a busy machine a connection to the master may break
  constexpr double kBetween = 0.1;  // wall time between two tries [s]
  XmlRpcValue request, response, answer;
  request[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < words.size(); ++i) request[static_cast<int>(i) + 1] = words[i];
  for (int tries = 0; tries < kTries; ++tries) {
    if (tries > 0) ros::WallDuration(kBetween).sleep();
    // As ros::master::execute, which refuses once ROS is being shut down.
    XmlRpc::XmlRpcClient master(ros::master::getHost().c_str(), static_cast<int>(ros::master::getPort()), "/");
    if (master.execute(call, request, response) && !master.isFault() &&
        ros::XMLRPCManager::instance()->validateXmlrpcResponse(call, response, answer))
      return answer;
  }
  return std::nullopt;
}

bool set_parameter(const std::string& name, const XmlRpcValue& value) {
  return ask_master("setParam", {XmlRpcValue(name), value}).has_value();
}

void put_back_sim_time(const std::string& found) {
  if (found.empty()) return;
  // Nobody is told where it fails: the master may have ended first, and its parameters with it.
  const std::string parameter = ros::names::resolve("/use_sim_time");  // which a launch file may have remapped
  if (found == "unset") ask_master("deleteParam", {XmlRpcValue(parameter)});
  if (found == "true" || found == "false") set_parameter(parameter, XmlRpcValue(found == "true"));
  ask_master("deleteParam", {XmlRpcValue(ros::names::resolve(names::kSimTimeFound))});
}

void end_launch() {
  if (!launched()) return;
  kill(getppid(), SIGINT);
  while (ros::ok()) wait();
}

void end_launch_when_rviz_is_closed() {
  const auto is_open = [rviz = ros::names::resolve("rviz")] {
    return ros::ok() && ask_master("lookupNode", {XmlRpcValue(rviz)});
  };
  if (is_open()) ROS_INFO("the test is over; the launch ends when the window of rviz is closed");
  std::fflush(stdout);  // where this is no terminal it would be seen at the end only
  while (is_open()) wait();
  end_launch();
}

void write_verdict(const std::string& file, std::optional<int> code, const std::string& folder) {
  if (file.empty()) return;
  std::ofstream out(file);
  out << (code ? std::to_string(*code) : "") << '\n' << folder << '\n';
  out.close();
  if (!out) ROS_ERROR("cannot write %s", file.c_str());
}

}  // namespace knot_utm
