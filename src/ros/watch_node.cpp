#include "knot_utm/ros/watch_node.hpp"

#include <XmlRpcClient.h>
#include <XmlRpcValue.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/ros/batch_place.hpp"
#include "knot_utm/ros/gate.hpp"
#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/validate.hpp"
#include "knot_utm/study/batch.hpp"

namespace knot_utm {
namespace {

constexpr double kLook = 0.2;                  // wall time between two looks [s]
constexpr std::uint32_t kLargest = 64 * 1024;  // message to this node [bytes]
constexpr char kRviz[] = "rviz";
constexpr int kFailed = 1, kWrongInput = 2;

/// What roslaunch's own server answers: none where it is not there, or refuses.
std::optional<XmlRpc::XmlRpcValue> ask(const std::string& host, int port, const char* what) {
  XmlRpc::XmlRpcClient launch(host.c_str(), port, "/");
  XmlRpc::XmlRpcValue answer;
  if (!launch.execute(what, XmlRpc::XmlRpcValue(), answer) || launch.isFault()) return std::nullopt;
  if (answer.getType() != XmlRpc::XmlRpcValue::TypeArray || answer.size() != 3) return std::nullopt;
  return answer[2];
}

/// "bench/utm_node-3", as roslaunch calls the process of the node /bench/utm_node.
std::string node_of_process(const std::string& process) { return "/" + process.substr(0, process.rfind('-')); }

}  // namespace

WatchNode::WatchNode(const ros::NodeHandle& node, std::string verdict) : node_(node), verdict_(std::move(verdict)) {
  std::map<std::string, int> codes;
  if (!node_.getParam(names::kExitCodes, codes) || codes.empty()) {
    throw InvalidInput::missing(node_.resolveName(names::kExitCodes), "the nodes of the test, as tighten.launch does");
  }
  for (const auto& [name, code] : codes) {
    watched_[node_.resolveName(name)] = node_.resolveName(std::string(names::kExitCodes) + "/" + name);
  }
  recorder_ = subscribe_gated(node_, {names::kRecorderStatus, names::kRecorderNode, 1, kLargest},
                              &WatchNode::on_recorder, this);
  if (!find_launch())
    throw InvalidInput::sentence("watch_node", "started by hand",
                                 "watch_node ends the launch that it is a part of, so it cannot be started by hand");
}

bool WatchNode::find_launch() {
  launch_ = getppid();
  // Several of them may use one master.
  std::map<std::string, std::string> servers;
  ros::param::get("/roslaunch/uris", servers);
  for (const auto& [name, uri] : servers) {
    std::uint32_t port = 0;
    if (!ros::network::splitURI(uri, host_, port)) continue;
    port_ = static_cast<int>(port);
    std::optional<XmlRpc::XmlRpcValue> pid = ask(host_, port_, "get_pid");
    if (pid && pid->getType() == XmlRpc::XmlRpcValue::TypeInt && static_cast<int>(*pid) == launch_) return true;
  }
  return false;
}

int WatchNode::spin() {
  while (ros::ok()) {
    ros::WallDuration(kLook).sleep();
    ros::spinOnce();
    if (ended_) continue;  // roslaunch ends this node, too
    if (getppid() != launch_) {
      ROS_ERROR("roslaunch died: the nodes of the test are shut down");
      end_nodes();
      break;
    }
    if (const std::optional<Processes> processes = ask_launch()) look(*processes);
  }
  if (folder_.empty() && !over_) {
    folder_ = told_folder();
    tell(std::nullopt);
  }
  tell_unfinished_batch();
  return 0;
}

void WatchNode::on_recorder(const RecorderStatus::ConstPtr& status) {
  if (status->run == 0) return;  // a recorder that was started anew knows nothing yet
  batch_ = status->batch;
  const std::string before = folder_;
  folder_ = one_line(batch_.empty() ? status->directory : batch_);
  if (folder_ != before && !over_) tell(std::nullopt);
}

/// What the recorder told the master, for a launch that was cut off before the recorder's first message came.
std::string WatchNode::told_folder() const {
  const auto text = [this](const char* parameter) {
    std::optional<XmlRpc::XmlRpcValue> value = get_from_master(node_.resolveName(parameter));
    return value && value->getType() == XmlRpc::XmlRpcValue::TypeString ? static_cast<std::string>(*value) : "";
  };
  const std::string id = text(names::kTestId);
  for (const char* parameter : {names::kFolderOfBatch, names::kFolderOfTest}) {
    const std::string told = text(parameter);
    if (!id.empty() && told.rfind(id + "/", 0) == 0) return one_line(told.substr(told.find(' ') + 1));
  }
  return "";
}

void WatchNode::tell_unfinished_batch() const {
  if (batch_.empty() || is_complete_batch(batch_)) return;
  // ROS may be shut down by now.
  std::printf("not all specimens of the batch in %s were tested; test the others by: %s\n", batch_.c_str(),
              command_to_resume(batch_).c_str());
  std::fflush(stdout);
}

std::optional<WatchNode::Processes> WatchNode::ask_launch() const {
  std::optional<XmlRpc::XmlRpcValue> lists = ask(host_, port_, "list_processes");
  if (!lists || lists->getType() != XmlRpc::XmlRpcValue::TypeArray || lists->size() != 2) return std::nullopt;
  Processes processes;
  for (const int alive : {0, 1}) {  // the dead last, of which the second list is
    XmlRpc::XmlRpcValue& list = (*lists)[1 - alive];
    for (int i = 0; i < list.size(); ++i) {
      processes[node_of_process(static_cast<std::string>(list[i][0]))] = alive == 1;
    }
  }
  return processes;
}

std::optional<int> WatchNode::exit_code(const std::string& node) const {
  std::optional<XmlRpc::XmlRpcValue> code = get_from_master(watched_.at(node));
  if (!code || code->getType() != XmlRpc::XmlRpcValue::TypeInt || static_cast<int>(*code) < 0) return std::nullopt;
  return static_cast<int>(*code);
}

void WatchNode::look(const Processes& processes) {
  const auto alive = [&](const std::string& node) {
    const auto found = processes.find(node);
    return found != processes.end() && found->second;
  };
  const bool somebody_looks = alive(node_.resolveName(kRviz));
  if (over_) return somebody_looks ? void() : end_launch();
  for (const char* runs_the_test : {names::kUtmNode, names::kReplayNode}) {
    const std::string node = node_.resolveName(runs_the_test);
    if (watched_.count(node) == 0 || processes.count(node) == 0 || alive(node)) continue;
    const std::optional<int> code = exit_code(node);
    // A picture of what never ran, or died in the midst of it, nobody needs.
    return test_is_over(code.value_or(kFailed), somebody_looks && code && *code != kWrongInput);
  }
  for (const auto& [node, parameter] : watched_) {
    if (processes.count(node) == 0 || alive(node)) continue;
    return test_is_over(exit_code(node) == kWrongInput ? kWrongInput : kFailed, false);
  }
}

void WatchNode::test_is_over(int code, bool somebody_looks) {
  over_ = true;
  tell(code);
  if (!somebody_looks) return end_launch();
  ROS_INFO("the test is over; the launch ends when the window of rviz is closed");
  std::fflush(stdout);  // where this is no terminal it would be seen at the end only
}

void WatchNode::tell(std::optional<int> code) const {
  if (verdict_.empty()) return;
  std::ofstream file(verdict_);
  if (code) file << *code;
  file << '\n' << folder_ << '\n';
  file.close();
  if (!file) ROS_ERROR("cannot write %s", verdict_.c_str());
}

void WatchNode::end_launch() {
  ended_ = true;
  kill(launch_, SIGINT);
}

void WatchNode::end_nodes() const {
  for (const auto& [node, parameter] : watched_) {
    XmlRpc::XmlRpcValue request, response, uri;
    request[0] = ros::this_node::getName();
    request[1] = node;
    std::string host;
    std::uint32_t port = 0;
    if (!ros::master::execute("lookupNode", request, response, uri, false)) continue;
    if (!ros::network::splitURI(static_cast<std::string>(uri), host, port)) continue;
    request[1] = "roslaunch died";
    XmlRpc::XmlRpcClient(host.c_str(), static_cast<int>(port), "/").execute("shutdown", request, response);
  }
}

}  // namespace knot_utm
