#pragma once

#include <span>

#include "io/text/numbers.h"
#include "io/text/source.h"

/// One file of an OpenFOAM case: a header and lists, in text or in binary.
///
///     FoamScanner scan(source, source.append(folder / "owner"));
///     const FoamForm form = scan.header();
///     const std::vector<Index> owner = scan.labels(form, {"a cell"});
namespace winslow::io::openfoam {

/// How a file holds its lists, as the entries `format`, `class` and `arch` of its header say.
struct FoamForm {
  bool binary = false;
  bool big_endian = false;
  std::size_t label_bytes = 4, scalar_bytes = 8;
  std::string content;  ///< the class: "faceList", "faceCompactList", ...

  BinaryNumber label() const { return {false, true, label_bytes}; }
  BinaryNumber scalar() const { return {true, true, scalar_bytes}; }
};

/// The numbers of a list, and where each entry begins in the source.
template <class Number>
struct FoamList {
  std::vector<Number> values;
  std::vector<std::size_t> places;
};

/// Faces of any number of points, one after another.
struct FoamFaces {
  std::vector<Index> offsets{0};  ///< #faces + 1, into nodes
  std::vector<Index> nodes;
  std::vector<std::size_t> places;  ///< where each face begins in the source

  Index size() const { return static_cast<Index>(offsets.size()) - 1; }
  std::span<const Index> operator[](Index face) const {
    const auto begin = static_cast<std::size_t>(offsets[at(face)]);
    return std::span(nodes).subspan(begin, at(offsets[at(face) + 1]) - begin);
  }
  void add(std::span<const Index> face, std::size_t place);
};

/// Splits a file of OpenFOAM into words: skips comments; each of ( ) { } ; [ ] is a word. All
/// functions throw InputError, which names the place.
class FoamScanner {
 public:
  FoamScanner(Source& source, Source::Range range)
      : source_(source), scan_(source, range.begin, range.end), range_(range) {}

  /// Offset of the next word.
  std::size_t offset() {
    skip();
    return scan_.offset();
  }
  /// Offset right after the last word.
  std::size_t position() const { return scan_.offset(); }
  void seek(std::size_t offset) { scan_.seek(offset); }

  /// The next word; empty at the end of the file.
  std::string_view next();
  std::string_view peek();
  /// Reads the next word. Throws InputError if it is another one.
  void expect(std::string_view word);
  std::int64_t integer(const Expected& expected);
  double number(const Expected& expected);
  /// Reads the length of a list with entries of at least `bytes_each` bytes.
  Index count(const Expected& expected, std::size_t bytes_each);

  /// Reads the entry FoamFile, if there is one.
  FoamForm header();
  /// Reads a list of labels, none less than `least`: "3(0 1 2)", "3{7}", or binary.
  FoamList<Index> labels(const FoamForm& form, const Expected& entry, Index least = 0);
  /// Reads a list of points, three numbers each: "2((0 0 0) (1 0 0))", or binary.
  FoamList<double> points(const FoamForm& form);
  /// Reads a list of faces of points 0 to points - 1, compact or not.
  FoamFaces faces(const FoamForm& form, Index points);

  [[noreturn]] void fail(std::string_view word, const std::string& expected) const {
    scan_.fail(word, expected);
  }

 private:
  void skip();
  /// Reads the length of a list of numbers, and the bracket that begins a list that is not empty.
  Index open_list(const FoamForm& form, const Expected& expected, std::size_t text_bytes,
                  std::size_t binary_bytes);
  void close_list(const FoamForm& form, Index count);
  FoamFaces compact_faces(const FoamForm& form, Index points);
  Index point_of_face(std::int64_t node, std::size_t place, Index points) const;

  Source& source_;
  Scanner scan_;
  Source::Range range_;
};

/// The text of a file's header with another value of an entry that it has; else unchanged.
std::string with_entry(const std::string& header, std::string_view key, const std::string& value);

/// Writes "N(...)" of points in the form of a file, without its header.
void write_points(TextWriter& out, std::span<const double> xyz, const FoamForm& form);

}  // namespace winslow::io::openfoam
