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

/// An option or an argument that makes no sense (unknown marker, damping outside (0, 1], ...).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be read, or whose content is wrong. what() reads
/// "FILE:LINE: found ..., expected ..." (or "FILE: byte N: ...").
class InputError : public Error {
 public:
  using Error::Error;
};

/// A file that cannot be written. The target is left as it was.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// What part of a mesh a MeshError is about.
enum class MeshEntity { mesh, node, element, marker_face };

/// Arrays that do not form a mesh (non-manifold edge, id out of range, ...). Names the entity, so
/// that a reader can add the line of the file it came from.
class MeshError : public Error {
 public:
  /// entity, index: the offender; for marker_face, marker is its marker and index the face in it.
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

/// The numbers went wrong (singular matrix, a NaN in the coordinates).
class NumericError : public Error {
 public:
  using Error::Error;
};

/// A symmetric matrix that a solver needs to be positive definite is not: Cholesky met a pivot that
/// is not positive, or conjugate gradients a direction of negative curvature.
class NotPositiveDefinite : public NumericError {
 public:
  using NumericError::NumericError;
};

/// The user cancelled; nothing was changed.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace winslow
