#include "apps/html_page.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace scarp::apps {
namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
    case '&':
      safe += "&amp;";
      break;
    case '<':
      safe += "&lt;";
      break;
    case '>':
      safe += "&gt;";
      break;
    case '"':
      safe += "&quot;";
      break;
    default:
      safe += c;
    }
  }
  return safe;
}

// RFC 4648.
std::string base64(const std::string& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
    };
    const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (unsigned digit = 0; digit < 4; ++digit)
      text += i + digit > bytes.size() ? '=' : digits[group >> (18 - 6 * digit) & 63U];
  }
  return text;
}

constexpr const char* style = R"(
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 72rem; padding: 1rem; font: 16px/1.5 "DejaVu Sans", Verdana, sans-serif;
  color: #222; background: #fff; }
h1 { font-size: 1.6rem; line-height: 1.25; } h2 { font-size: 1.25rem; margin-top: 2.5rem; }
figure { margin: 1.5rem 0; } img { max-width: 100%; height: auto; display: block; }
figcaption, caption { color: #444; font-size: .9rem; text-align: left; padding: .4rem 0; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: .85rem; }
th, td { border-bottom: 1px solid #ccc; padding: .25rem .7rem; text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } thead th { border-bottom: 2px solid #555; }
pre { overflow-x: auto; background: #f4f4f4; padding: .8rem; font-size: .85rem; }
nav a { margin-right: 1rem; white-space: nowrap; } a { color: #0a58a6; }
)";

} // namespace

void HtmlPage::heading(const std::string& text) {
  ++headings_;
  contents_ += fmt::format("<a href=\"#s{}\">{}</a> ", headings_, escaped(text));
  body_ += fmt::format("<h2 id=\"s{}\">{}</h2>\n", headings_, escaped(text));
}

void HtmlPage::paragraph(const std::string& text) {
  body_ += fmt::format("<p>{}</p>\n", escaped(text));
}

void HtmlPage::listing(const std::vector<std::string>& lines) {
  body_ += "<pre>";
  for (const std::string& line : lines) body_ += escaped(line) + "\n";
  body_ += "</pre>\n";
}

void HtmlPage::table(const std::string& caption, const std::vector<std::string>& header,
                     const std::vector<std::vector<std::string>>& rows) {
  const auto row_text = [&](const std::vector<std::string>& cells, const char* tag) {
    if (cells.size() != header.size())
      throw std::invalid_argument("a row of a table has not as many cells as its header");
    std::string text = "<tr>";
    for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    return text + "</tr>\n";
  };
  body_ +=
      fmt::format("<div class=\"wide\"><table><caption>{}</caption>\n<thead>{}</thead>\n<tbody>",
                  escaped(caption), row_text(header, "th"));
  for (const std::vector<std::string>& row : rows) body_ += row_text(row, "td");
  body_ += "</tbody></table></div>\n";
}

void HtmlPage::picture(const std::filesystem::path& png, const std::string& caption) {
  body_ += fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\">\n"
                       "<figcaption>{0}</figcaption></figure>\n",
                       escaped(caption), base64(io::read_text(png)));
}

std::string HtmlPage::text() const {
  return fmt::format("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<title>{0}</title><style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n"
                     "<nav>{2}</nav>\n{3}</body></html>\n",
                     escaped(title_), style, contents_, body_);
}

} // namespace scarp::apps
