// Where a body begins to fail: bisection over the factor that divides its strength.
#pragma once

#include <functional>
#include <optional>

namespace scarp::apps {

struct SearchOptions {
  double lower = 0.25;     ///< -, smallest factor that is tried
  double upper = 4.0;      ///< -, largest
  double tolerance = 0.01; ///< -, largest width of the bracket that is found
};

/// What the trials say.  Without one of the two the factor lies beyond that end of the search.
struct Bracket {
  std::optional<double> stable; ///< -, largest factor below all that fail
  std::optional<double> failed; ///< -, smallest factor that fails
  /// Whether no factor that fails is smaller than one that does not.
  bool monotone = true;
};

/// Tries both ends, halves until the bracket is as narrow as the tolerance, then tries a factor a
/// tolerance beyond either side of it: a verdict that depends on chance shows there.  Each factor
/// is tried once, none outside lower .. upper.  Throws std::invalid_argument if the options make no
/// sense, and what `fails` throws.
Bracket find_bracket(const SearchOptions& options, const std::function<bool(double)>& fails);

} // namespace scarp::apps
