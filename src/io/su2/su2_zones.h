#pragma once

#include <string>
#include <vector>

#include "io/text/source.h"

namespace winslow::io::su2 {

/// The zones of a file (NZONE=, IZONE=), each from its IZONE= line to the next one's.
struct ZoneList {
  struct Zone {
    int number;
    std::size_t begin, end;
  };
  std::vector<Zone> zones;  ///< never empty
  bool several = false;     ///< false: one zone, which is the whole file

  std::vector<int> numbers() const;
  /// What stands before the first zone, then each zone.
  std::vector<std::string> blocks(const Source& source) const;
};

/// Throws InputError where NZONE= and IZONE= do not fit one another.
ZoneList find_zones(const Source& source);

/// Place of a zone in the list; 0: the first. Throws UsageError if there is none of that number.
std::size_t choose_zone(const ZoneList& list, int number, const std::string& file);

/// "1, 2, 4".
std::string listed(const std::vector<int>& numbers);

}  // namespace winslow::io::su2
