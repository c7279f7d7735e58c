#include "knot_utm/ros/journal_bag.hpp"

#include "knot_utm/ros/run_bag.hpp"

namespace knot_utm {

void recover_with_bag(Recovery& recovery) {
  RunBag bag(recovery.place() + "/test.bag", recovery.method());
  Record record;
  while (recovery.next(record)) bag.add(record);
  bag.close();
  recovery.finish();
}

void save_bag(const std::string& folder, const Method& method, const std::string& file) {
  JournalReader journal(folder);
  RunBag bag(file, method);
  Record record;
  while (journal.next(record)) bag.add(record);
  bag.close();
}

}  // namespace knot_utm
