// One self-contained HTML page: words, tables and embedded pictures, no network, no script.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::apps {

/// Text arguments are plain: they are escaped.
class HtmlPage {
 public:
  explicit HtmlPage(std::string title) : title_(std::move(title)) {}

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  /// Lines to be copied, such as commands or equations.
  void listing(const std::vector<std::string>& lines);
  /// Throws std::invalid_argument unless every row has as many cells as the header.
  void table(const std::string& caption, const std::vector<std::string>& header,
             const std::vector<std::vector<std::string>>& rows);
  /// Embeds a PNG file.  Throws std::runtime_error if it cannot be read.
  void picture(const std::filesystem::path& png, const std::string& caption);

  std::string text() const;

 private:
  std::string title_;
  std::string contents_; ///< links to the headings
  std::string body_;
  int headings_ = 0;
};

} // namespace scarp::apps
