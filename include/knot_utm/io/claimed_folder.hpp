#pragma once

#include <string>

#include "knot_utm/io/journal.hpp"

namespace knot_utm {

/// The folder of a new run, which its journal holds against every other run.
struct ClaimedFolder {
  std::string folder;
  JournalWriter journal;
};

/// Begins a run in `folder`, or in the first of `folder-2`, `folder-3` and so on where `folder` holds a run: one that
/// has ended, was cut off or goes on. Nothing that was measured is written over. Throws as JournalWriter does.
ClaimedFolder claim_folder(const std::string& folder, const JournalHeader& header);

/// What is said where a run was asked to go to one folder and goes to another.
std::string moved_notice(const std::string& asked, const std::string& used);

}  // namespace knot_utm
