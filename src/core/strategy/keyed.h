#pragma once

#include <cstddef>
#include <optional>
#include <utility>

namespace winslow {

/// Keeps what is made from some inputs, and makes it anew when one of them is another:
///
///   Keyed<PatternKey, std::shared_ptr<const Pattern>> pattern_;
///   const auto& pattern = pattern_.of({unknowns, threads}, [&] { return make_pattern(); });
///
/// The key names all inputs, and is compared by ==. Large inputs are shared_ptrs in it, compared by
/// identity: the key keeps them alive, so that no other object can come to lie where one of them
/// lay. Nothing has to say that a product is out of date.
template <typename Key, typename Product>
class Keyed {
 public:
  /// The product of this key, made by make() unless it is the last one that was asked for. If
  /// make() throws, there is none, and the next call makes it.
  template <typename Make>
  const Product& of(const Key& key, Make&& make) {
    if (!kept_ || !(kept_->key == key)) {
      kept_.reset();
      Product product = std::forward<Make>(make)();
      kept_.emplace(Kept{key, std::move(product)});
      ++times_made_;
    }
    return kept_->product;
  }
  /// How often a product was made.
  std::size_t times_made() const { return times_made_; }

 private:
  struct Kept {
    Key key;
    Product product;
  };
  std::optional<Kept> kept_;
  std::size_t times_made_ = 0;
};

}  // namespace winslow
