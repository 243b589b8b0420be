// The tables of the reproduction of Wu et al. 2017, on the terminal and as a page.
#pragma once

#include "apps/wu2017_case.hpp"
#include "apps/wu2017_figures.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::apps {

struct ReportTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

class Wu2017Report {
 public:
  /// Keeps a reference to the results.
  Wu2017Report(const Wu2017& results, const analysis::MeasureOptions& measure);

  void print() const;
  /// Throws std::runtime_error.
  void write_page(const std::filesystem::path& file, const std::vector<Figure>& figures) const;

 private:
  ReportTable base_case() const;
  ReportTable agreements() const;
  ReportTable scenarios() const;
  ReportTable fits() const;
  ReportTable regression(const Regressions& regressions, const std::string& caption) const;
  std::vector<std::string> equations() const;
  std::vector<std::string> definitions() const;
  std::vector<std::string> differences() const;
  double run_time() const; ///< s, wall time of all scenarios

  const Wu2017& results_;
  analysis::MeasureOptions measure_;
};

} // namespace scarp::apps
