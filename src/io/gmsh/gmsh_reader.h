#pragma once

#include <set>

#include "io/gmsh/gmsh.h"
#include "io/gmsh/section_readers.h"

namespace winslow::io::gmsh {

/// Reads the sections of one MSH file in the order in which they come.
class Reader {
 public:
  explicit Reader(Source& source) : source_(source), scan_(source) { mesh_.details = details_; }
  ParsedMesh read();

 private:
  void read_header();
  void read_section();
  void read_raw(const std::string& name, std::size_t begin);
  void read_physical_names();
  void end_section(const std::string& name);
  bool seen(std::string_view section) const;

  void read_entities();
  void read_entity(ValueReader& values, int dimension, Index index, Index count);
  std::vector<int> read_tags(ValueReader& values, const char* what);

  void finish();

  Source& source_;
  Scanner scan_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  NodeReader nodes_{scan_, *details_, mesh_};
  ElementReader elements_{scan_, nodes_.tags(), *details_, mesh_};
  std::set<std::pair<int, int>> named_groups_;  ///< dimension and tag
};

}  // namespace winslow::io::gmsh
