#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "io/gmsh/gmsh.h"
#include "io/gmsh/node_tags.h"
#include "io/gmsh/values.h"

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
  void read_entity(Values& values, int dimension, Index index, Index count);
  std::vector<int> read_tags(Values& values, const char* what);

  void read_nodes();
  void read_nodes_2(Values& values);
  void read_nodes_4(Values& values);
  void read_node_block(Values& values, Index block, Index blocks, Index total);
  void add_node_tag(std::int64_t tag, std::size_t offset);
  void index_nodes();

  void read_elements();
  void read_elements_2_text(Values& values, Index count);
  void read_elements_2_binary(Values& values, Index count);
  void read_elements_4(Values& values);
  struct Record {
    Item item;
    std::size_t offset;
    Expected expected;
  };
  Shape shape_of(int type, std::size_t offset) const;
  void skip_tag(Values& values, int position, Item& item, const Expected& expected);
  void read_element_nodes(Values& values, const Record& record);
  bool repeats_last_element(std::span<const Index> corners, const Item& item) const;

  void collect_groups();
  void finish();

  Source& source_;
  Scanner scan_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  NodeTags node_tags_;
  std::vector<double> xyz_;
  std::vector<std::size_t> item_offsets_;
  std::set<std::pair<int, int>> named_groups_;  ///< dimension and tag
  bool parametric_ = false;
  bool partitioned_ = false;
};

}  // namespace winslow::io::gmsh
