// Charts on logarithmic axes.
#pragma once

#include "apps/bench/report.hpp"

namespace scarp::bench {

/// The same chart with both axes logarithmic, with ticks at powers of ten and, where these are few,
/// at 2 and 5 times them.  Values that are not positive are left out.
render::Chart log_log(render::Chart chart);

/// Errors with markers, and for each order a dashed line of that slope through the finest value of
/// the first of them.
render::Chart convergence_chart(const std::vector<Convergence>& measured,
                                const std::vector<double>& orders, const std::string& x_name,
                                const std::string& y_name, const std::string& title = {});

} // namespace scarp::bench
