#include "io/gmsh/value_reader.h"

namespace winslow::io::gmsh {
namespace {

/// Reads $Entities and $PartitionedEntities.
class EntityReader {
 public:
  EntityReader(Scanner& scan, Details& details) : scan_(scan), details_(details) {}

  void read_entities() {
    const std::size_t begin = scan_.offset();
    if (!details_.version_4) source().fail(begin, "$Entities in MSH 2", "$Nodes");
    ValueReader values(scan_, details_.binary);
    values.begin();
    std::array<Index, 4> counts{};
    for (Index& n : counts) n = values.count({"a number of entities"}, 8, 36);
    values.end({"the end of the line"});
    for (int dimension = 0; dimension < 4; ++dimension) {
      const Index n = counts[at(dimension)];
      for (Index i = 0; i < n; ++i) read_entity(values, dimension, i, n);
    }
  }

  std::int64_t read_parts() {
    if (!details_.version_4) source().fail(scan_.offset(), "$PartitionedEntities in MSH 2", "4.1");
    ValueReader values(scan_, details_.binary);
    values.begin();
    const std::int64_t partitions = values.size({"the number of partitions"});
    values.end({"the end of the line"});
    values.begin();
    const Index ghosts = values.count({"the number of ghost entities"}, 4, 8);
    values.end({"the end of the line"});
    for (Index g = 0; g < ghosts; ++g) {
      const Expected expected{"ghost entity", g, ghosts};
      values.begin();
      values.integer(expected);
      values.integer(expected);
      values.end(expected);
    }
    values.begin();
    std::array<Index, 4> counts{};
    for (Index& n : counts) n = values.count({"a number of partitioned entities"}, 10, 56);
    values.end({"the end of the line"});
    for (int dimension = 0; dimension < 4; ++dimension) {
      const Index n = counts[at(dimension)];
      for (Index i = 0; i < n; ++i) read_part(values, dimension, {"partitioned entity", i, n});
    }
    return partitions;
  }

 private:
  void read_entity(ValueReader& values, int dimension, Index index, Index count) {
    const std::string what = std::string(entity_names[at(dimension)]) + " entity";
    const Expected expected{what.c_str(), index, count};
    values.begin();
    Entity entity;
    entity.tag = values.integer(expected);
    for (std::size_t k = 0; k < box_numbers[at(dimension)]; ++k)
      entity.box[k] = values.real(expected);
    entity.physicals = read_tags(values, "a physical tag");
    if (dimension > 0) entity.boundary = read_tags(values, "the tag of a bounding entity");
    values.end(expected);
    details_.entities[at(dimension)].push_back(std::move(entity));
  }

  void read_part(ValueReader& values, int dimension, const Expected& expected) {
    values.begin();
    Entity part;
    part.tag = values.integer(expected);
    const int of_dimension = values.integer(expected);
    values.integer(expected);  // tag of the entity that it is a piece of
    read_tags(values, "a partition");
    for (std::size_t k = 0; k < box_numbers[at(dimension)]; ++k) values.real(expected);
    part.physicals = read_tags(values, "a physical tag");
    // What Gmsh cut between partitions is in the groups of what it cut, which are of another
    // dimension.
    if (of_dimension != dimension) part.physicals.clear();
    if (dimension > 0) read_tags(values, "the tag of a bounding entity");
    values.end(expected);
    details_.parts[at(dimension)].push_back(std::move(part));
  }

  std::vector<int> read_tags(ValueReader& values, const char* what) {
    const Index n = values.count({what}, 2, 4);
    std::vector<int> tags(static_cast<std::size_t>(n));
    for (int& tag : tags) tag = values.integer({what});
    return tags;
  }

  const Source& source() const { return scan_.source(); }

  Scanner& scan_;
  Details& details_;
};

}  // namespace

void read_entities(Scanner& scan, Details& details) { EntityReader(scan, details).read_entities(); }

std::int64_t read_parts(Scanner& scan, Details& details) {
  return EntityReader(scan, details).read_parts();
}

}  // namespace winslow::io::gmsh
