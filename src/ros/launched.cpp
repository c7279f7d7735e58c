#include "knot_utm/ros/launched.hpp"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/param.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "knot_utm/ros/master_parameters.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr double kLookAtLaunch = 0.2;  // wall time between two looks at the launch [s]

std::vector<std::string> words_of(const std::string& process) {
  std::ifstream file("/proc/" + process + "/cmdline");
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

bool launched() {
  for (const std::string& word : words_of(std::to_string(getppid())))
    if (fs::path(word).filename() == "roslaunch") return true;
  return false;
}

void wait(double seconds) { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(seconds)); }

}  // namespace

std::set<std::string> nodes_of_launch() {
  constexpr char kName[] = "__name:=";  // as roslaunch tells each node its name
  std::set<std::string> nodes;
  if (!launched()) return nodes;
  std::error_code gone;
  for (const auto& thread : fs::directory_iterator("/proc/" + std::to_string(getppid()) + "/task", gone)) {
    std::ifstream children(thread.path() / "children");
    for (std::string process; children >> process;)
      for (const std::string& word : words_of(process))
        if (word.rfind(kName, 0) == 0) nodes.insert(word.substr(sizeof kName - 1));
  }
  return nodes;
}

void end_with_launch() {
  if (launched()) prctl(PR_SET_PDEATHSIG, SIGINT);
}

void end_launch() {
  if (!launched()) return;
  kill(getppid(), SIGINT);
  while (ros::ok()) wait(kLookAtLaunch);
}

void wait_for_end_of(const char* node) {
  while (ros::ok() && nodes_of_launch().count(node) > 0) wait(kLookAtLaunch);
}

void end_launch_when_rviz_is_closed() {
  constexpr char kRviz[] = "rviz";
  if (nodes_of_launch().count(kRviz) > 0)
    ROS_INFO("the test is over; the launch ends when the window of rviz is closed");
  std::fflush(stdout);  // where this is no terminal it would be seen at the end only
  wait_for_end_of(kRviz);
  end_launch();
}

void write_verdict(const std::string& file, std::optional<int> code, const std::string& folder) {
  if (file.empty()) return;
  std::ofstream out(file);
  out << (code ? std::to_string(*code) : "") << '\n' << folder << '\n';
  out.close();
  if (!out) ROS_ERROR("cannot write %s", file.c_str());
}

SimTimeFound::SimTimeFound()
    : parameter_(ros::names::resolve("/use_sim_time")), note_(ros::names::resolve(names::kSimTimeFound)) {
  ros::param::get(note_, found_);
}

SimTimeFound::~SimTimeFound() {
  // Nobody is told where it fails: the master may have ended first, and its parameters with it.
  if (found_ == "unset") delete_on_master(parameter_);
  if (found_ == "true" || found_ == "false") set_on_master(parameter_, XmlRpc::XmlRpcValue(found_ == "true"));
  if (!found_.empty()) delete_on_master(note_);
}

}  // namespace knot_utm
