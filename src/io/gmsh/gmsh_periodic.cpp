#include "io/gmsh/value_reader.h"

#include <cstdlib>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/types.h"

namespace winslow::io::gmsh {
namespace {

constexpr std::size_t affine_size = 16;

int entity_tag(ValueReader& values, const Source& source, const Expected& expected) {
  const std::size_t start = values.offset();
  const int tag = values.integer(expected);
  if (tag == 0 || tag == std::numeric_limits<int>::min())
    source.fail(start, std::to_string(tag), expected.text());
  return std::abs(tag);  // negative: the reversed entity
}

void read_affine_4(ValueReader& values, const Source& source, PeriodicLink& link) {
  const std::size_t begin = values.begin();
  const Index n = values.count({"the number of values of an affine transform"}, 2, 8);
  if (n != 0 && at(n) != affine_size)
    source.fail(begin, std::to_string(n) + " values of an affine transform", "0 or 16");
  for (Index k = 0; k < n; ++k)
    link.affine.push_back(values.real({"value of an affine transform", k, n}));
  values.end({"the end of the line after an affine transform"});
}

/// The line "Affine ..." of MSH 2, if there is one.
void read_affine_2(Scanner& scan, PeriodicLink& link) {
  scan.skip_space();
  const std::size_t begin = scan.offset();
  if (scan.word() != "Affine") return scan.seek(begin);
  for (std::size_t k = 0; k < affine_size; ++k)
    link.affine.push_back(
        scan.number({"value of an affine transform", static_cast<Index>(k), affine_size}));
  scan.end_line({"the end of the line after 16 values"});
}

PeriodicLink read_link(Scanner& scan, ValueReader& values, bool version_4,
                       const Expected& expected) {
  PeriodicLink link;
  link.offset = values.begin();
  link.dimension = values.integer(expected);
  if (link.dimension < 0 || link.dimension > 3)
    scan.source().fail(link.offset, "dimension " + std::to_string(link.dimension),
                       "a dimension from 0 to 3");
  link.entity = entity_tag(values, scan.source(), {"the tag of a periodic entity"});
  link.master = entity_tag(values, scan.source(), {"the tag of its master entity"});
  values.end({"the end of the line after a master entity"});
  if (version_4)
    read_affine_4(values, scan.source(), link);
  else
    read_affine_2(scan, link);
  values.begin();
  const Index n = values.count({"the number of pairs of nodes"}, 4, 16);
  values.end({"the end of the line after the number of pairs"});
  link.nodes.reserve(static_cast<std::size_t>(n));
  for (Index k = 0; k < n; ++k) {
    values.begin();
    const Expected of_node{"node of pair", k, n}, of_master{"master node of pair", k, n};
    const std::int64_t node = values.size(of_node);
    link.nodes.push_back({node, values.size(of_master)});
    values.end({"the end of the line after pair", k, n});
  }
  return link;
}

/// The links of entities of one dimension less than the elements.
std::vector<const PeriodicLink*> links_of_sides(const Details& details) {
  std::vector<const PeriodicLink*> links;
  for (const PeriodicLink& link : details.links)
    if (link.dimension + 1 == details.dimension) links.push_back(&link);
  return links;
}

/// The markers of the entities around a mesh.
class MarkedEntities {
 public:
  explicit MarkedEntities(const Details& details) : entities_(details.marker_sides.size()) {
    std::vector<int> entity_of(details.sides.size());
    for (const Item& item : details.items) {
      const int dimension = info_of(item.shape).dimension;
      if (dimension > 0 && dimension < details.dimension) entity_of[at(item.index)] = item.entity;
    }
    for (std::size_t m = 0; m < details.marker_sides.size(); ++m) {
      for (const Index coded : details.marker_sides[m]) {
        const int entity = entity_of[at(coded < 0 ? ~coded : coded)];
        entities_[m].insert(entity);
        markers_[entity].insert(m);
      }
    }
    for (const PeriodicLink* link : links_of_sides(details))
      linked_.insert({link->entity, link->master});
  }

  /// An entity of a marker that no link joins; none if links join all of them.
  std::optional<int> loose(std::size_t marker) const {
    for (const int entity : entities_[marker])
      if (!linked_.contains(entity)) return entity;
    return std::nullopt;
  }
  /// The marker of an entity; if there are several, preferably one that is periodic as a whole.
  std::optional<std::size_t> marker(int entity) const {
    const auto found = markers_.find(entity);
    if (found == markers_.end()) return std::nullopt;
    for (const std::size_t m : found->second)
      if (!loose(m)) return m;
    return *found->second.begin();
  }

 private:
  std::vector<std::set<int>> entities_;           // of each marker
  std::map<int, std::set<std::size_t>> markers_;  // by entity
  std::set<int> linked_;
};

bool same_affine(const std::vector<double>& a, const std::vector<double>& b) {
  double size = 1;
  for (const double value : a) size = std::max(size, std::abs(value));
  constexpr double noise = 1e-9;
  return !a.empty() && std::ranges::equal(a, b, [&](double p, double q) {
    return std::abs(p - q) <= noise * size;
  });
}

/// A pair of markers under construction.
struct Draft {
  GivenPairs pairs;
  const PeriodicLink* first;  ///< the first of its links
};

class PairBuilder {
 public:
  PairBuilder(const Source& source, const Details& details, const NodeTags& tags,
              const MeshData& data)
      : source_(source), details_(details), tags_(tags), data_(data), entities_(details) {}

  std::vector<GivenPairs> build() {
    for (const PeriodicLink* link : links_of_sides(details_)) add(*link);
    hold_corners();
    for (Draft& draft : drafts_) find_gaps(draft);
    std::vector<GivenPairs> all;
    for (Draft& draft : drafts_) all.push_back(std::move(draft.pairs));
    return all;
  }

 private:
  const std::string& name(std::size_t marker) const { return data_.markers[marker].name; }
  std::string entity_text(int entity) const {
    return std::string(entity_names[at(details_.dimension - 1)]) + ' ' + std::to_string(entity);
  }
  std::string fault(const PeriodicLink& link, const std::string& found,
                    const std::string& expected) const {
    return source_.where(link.offset) + ": found " + found + ", expected " + expected;
  }

  void add(const PeriodicLink& link) {
    const auto second = entities_.marker(link.entity), first = entities_.marker(link.master);
    if (!first && !second) return;
    Draft& draft = draft_of(link, name(first ? *first : *second), name(second ? *second : *first));
    std::string& wrong = draft.pairs.fault;
    if (!first || !second)
      wrong = fault(link,
                    entity_text(first ? link.master : link.entity) + " of marker \"" +
                        draft.pairs.first + "\" periodic with " +
                        entity_text(first ? link.entity : link.master) + " in no physical group",
                    "both in physical groups");
    for (const auto& marker : {first, second}) {
      if (!marker || !wrong.empty()) continue;
      if (const auto loose = entities_.loose(*marker))
        wrong =
            fault(link,
                  "marker \"" + name(*marker) + "\" periodic in part only: " + entity_text(*loose) +
                      " is in no link of $Periodic",
                  "all of it");
    }
    for (const auto& [own, master] : link.nodes) {
      const PeriodicPair pair{tags_.find(master), tags_.find(own)};
      if (pair.node >= 0 && pair.image >= 0) draft.pairs.pairs.push_back(pair);
    }
  }

  Draft& draft_of(const PeriodicLink& link, const std::string& first, const std::string& second) {
    for (Draft& draft : drafts_)
      if (draft.pairs.first == first && draft.pairs.second == second &&
          same_affine(draft.first->affine, link.affine))
        return draft;
    drafts_.push_back({{}, &link});
    drafts_.back().pairs.first = first;
    drafts_.back().pairs.second = second;
    return drafts_.back();
  }

  /// Holds the nodes that are in several pairs, where sides of two directions meet. A pair of nodes
  /// that two entities list counts once.
  void hold_corners() {
    std::map<Index, int> uses;
    for (Draft& draft : drafts_) {
      auto& pairs = draft.pairs.pairs;
      std::ranges::sort(pairs, [](const PeriodicPair& a, const PeriodicPair& b) {
        return std::tie(a.node, a.image) < std::tie(b.node, b.image);
      });
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    }
    for (const Draft& draft : drafts_)
      for (const auto& [node, image] : draft.pairs.pairs)
        for (const Index either : {node, image}) ++uses[either];
    for (Draft& draft : drafts_) {
      std::set<Index> held;
      for (const auto& [node, image] : draft.pairs.pairs)
        for (const Index either : {node, image})
          if (uses[either] > 1) held.insert(either);
      draft.pairs.held.assign(held.begin(), held.end());
    }
  }

  /// Finds a node of the markers that is in no pair.
  void find_gaps(Draft& draft) const {
    if (!draft.pairs.fault.empty()) return;
    for (const std::string& marker : {draft.pairs.first, draft.pairs.second}) {
      std::set<Index> paired;
      for (const Draft& other : drafts_) {
        if (other.pairs.first != marker && other.pairs.second != marker) continue;
        for (const auto& [node, image] : other.pairs.pairs) paired.insert({node, image});
      }
      for (const Marker& own : data_.markers) {
        if (own.name != marker) continue;
        for (const Face& face : own.faces)
          for (const Index node : face)
            if (!paired.contains(node) && draft.pairs.fault.empty())
              draft.pairs.fault = fault(
                  *draft.first,
                  "no pair with node " + std::to_string(node) + " of marker \"" + marker + "\"",
                  "one for each of its nodes");
      }
    }
  }

  const Source& source_;
  const Details& details_;
  const NodeTags& tags_;
  const MeshData& data_;
  MarkedEntities entities_;
  std::vector<Draft> drafts_;
};

std::vector<double> affine_of(const RigidImage& image) {
  std::vector<double> values;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column)
      values.push_back(image.rotation(row, column));
    values.push_back(image.offset[row]);
  }
  values.insert(values.end(), {0, 0, 0, 1});
  return values;
}

}  // namespace

std::vector<PeriodicLink> read_links(Scanner& scan, bool version_4, bool binary) {
  ValueReader values(scan, version_4 && binary);
  values.begin();
  const Index n = values.count({"the number of periodic entities"}, 8, 28);
  values.end({"the end of the line after the number of periodic entities"});
  std::vector<PeriodicLink> links;
  links.reserve(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i)
    links.push_back(read_link(scan, values, version_4, {"dimension of periodic entity", i, n}));
  return links;
}

std::vector<GivenPairs> pairs_of(const Source& source, const Details& details, const NodeTags& tags,
                                 const MeshData& data) {
  if (details.links.empty()) return {};
  return PairBuilder(source, details, tags, data).build();
}

std::vector<PeriodicLink> links_of(const FormatDetails& source, const Mesh& mesh) {
  std::vector<PeriodicLink> links;
  if (!source.periodic || !source.periodic->fits(*mesh.topology)) return links;
  const Topology& topology = *mesh.topology;
  for (const GivenPairs& given : source.periodic->pairs) {
    const auto first = topology.markers().find(given.first);
    const auto second = topology.markers().find(given.second);
    if (!given.fault.empty() || given.halo || !first || !second || *first == *second) continue;
    PeriodicLink link;
    link.dimension = topology.cell_dimension() - 1;
    link.entity = *second + 1;
    link.master = *first + 1;
    try {
      if (!source.plane)
        link.affine = affine_of(PeriodicPairs::of(topology, mesh.coordinates, given).image);
    } catch (const UsageError&) {
      continue;  // the nodes no longer match
    }
    for (const auto& [node, image] : given.pairs) link.nodes.push_back({image + 1, node + 1});
    links.push_back(std::move(link));
  }
  return links;
}

}  // namespace winslow::io::gmsh
