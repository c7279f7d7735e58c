#pragma once

#include <string>

#include "knot_utm/io/journal.hpp"

namespace knot_utm {

/// The folder of a new run. The journal in it is locked, so that no other run can use the folder.
struct ClaimedFolder {
  std::string folder;
  JournalWriter journal;
};

/// Begins a run in `folder`. Where that folder holds a run already (complete, cut off or still running), the first free
/// one of `folder-2`, `folder-3` and so on is used, so that nothing measured is overwritten. Throws as JournalWriter
/// does.
ClaimedFolder claim_folder(const std::string& folder, const JournalHeader& header);

/// The folder that claim_folder would use now.
std::string free_folder(const std::string& folder);

/// The notice for the user when a run goes to another folder than the one asked for.
std::string moved_notice(const std::string& asked, const std::string& used);

}  // namespace knot_utm
