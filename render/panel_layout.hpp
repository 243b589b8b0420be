// Equal panels of the x-z plane with their axes and colour bars.  Internal to render.
#pragma once

#include "render/colour_bar.hpp"
#include "render/plot_area.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace scarp::render {

struct FrameStyle;

struct PanelContent {
  Box view;                    ///< m, of every panel
  std::vector<ColourBar> bars; ///< one for all panels, or one a panel
  std::size_t panels = 1;
  std::size_t columns = 1;
  double font_size = 0.0; ///< px
  bool titled = false;    ///< the whole figure

  std::size_t rows() const { return (panels + columns - 1) / columns; }
  bool own_bars() const { return bars.size() > 1; }
};

/// Where everything is, px; panels row by row.
struct PanelLayout {
  bool upright_bars = false;
  int height = 0;     ///< of the picture
  double scale = 0.0; ///< a metre
  std::vector<Box> areas;
  std::vector<Box> bars;
};

/// What the style says of content: its font, columns and title.  Throws std::invalid_argument if
/// panels or style make no sense.
PanelContent panel_content(const FrameStyle& style, const Box& view, std::size_t panels);

/// One bar below or beside the panels, whichever leaves more room for the bodies; bars of their own
/// beside the panels if these are high enough.  A height of 0 is what all that needs.  Throws
/// std::invalid_argument if there is no room.
PanelLayout panel_layout(const PanelContent& content, int width, int height);

/// Axes, with numbers only where no other panel has them, and the words above the panel, after its
/// letter if there are several.
void draw_panel_frame(Drawing& drawing, const PanelContent& content, const PanelLayout& layout,
                      std::size_t panel, const std::string& text);

/// Colour bars and the title of the figure.
void draw_panel_surroundings(Drawing& drawing, const PanelContent& content,
                             const PanelLayout& layout, const std::string& title);

} // namespace scarp::render
