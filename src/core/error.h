#pragma once

#include <stdexcept>
#include <string>

#include "core/types.h"

/// What a client catches, the special before the general:
///
///     try {
///       state = winslow::execute(command, state).state;
///     } catch (const winslow::Cancelled&) {
///       return;  // the state is as it was
///     } catch (const winslow::Error& error) {
///       std::fprintf(stderr, "%s\n", error.what());  // one sentence for the user
///     }
///
/// Every error that the library throws. The program turns each class into one exit code.
namespace winslow {

/// Base of all errors of this library; what() is one sentence for the user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An invalid option or argument (unknown marker, damping outside (0, 1], ...).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be read or has wrong content. what() is
/// "FILE:LINE: found ..., expected ..." (or "FILE: byte N: ...").
class InputError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be written. The target is unchanged.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// "a, b, c": the texts of the items of a list, for messages.
template <class List, class TextOf>
std::string listed(const List& list, const TextOf& text_of) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + std::string(text_of(item));
  return text;
}

/// The part of a mesh that a MeshError is about.
enum class MeshEntity { mesh, node, element, marker_face };

/// Arrays that are no mesh (non-manifold edge, id out of range, ...). It names the entity, so that
/// a reader can add the line of the file.
class MeshError : public Error {
 public:
  /// entity, index: the faulty one. For marker_face, marker is the marker and index the face in it.
  MeshError(MeshEntity entity, Index index, const std::string& message, Index marker = -1)
      : Error(message), entity_(entity), index_(index), marker_(marker) {}
  MeshEntity entity() const { return entity_; }
  Index index() const { return index_; }
  Index marker() const { return marker_; }

 private:
  MeshEntity entity_;
  Index index_;
  Index marker_;
};

/// A numerical failure (singular matrix, NaN in the coordinates).
class NumericError : public Error {
 public:
  using Error::Error;
};

/// A symmetric matrix that should be positive definite is not: a pivot of Cholesky's method is not
/// positive, or conjugate gradients found a direction of negative curvature.
class NotPositiveDefinite : public NumericError {
 public:
  using NumericError::NumericError;
};

/// The user cancelled. Nothing is changed.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace winslow
