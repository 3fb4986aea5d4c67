/// Which file is whose, so that none serves two purposes.
#pragma once

#include <map>
#include <string>

namespace paperproof::compare {

/// Files are the same where their paths lead to the same place.
class ClaimedFiles {
 public:
  /// @return whether nobody has the file yet.
  bool claim(const std::string& path, const std::string& by);

  /// Nothing where the path is empty: the option was not given.
  /// @throws InputError naming the option, the file and whose it is.
  void claim_for_option(const std::string& option, const std::string& path);

 private:
  std::map<std::string, std::string> claimed_;  ///< By whom.
};

}  // namespace paperproof::compare
