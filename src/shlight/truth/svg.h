#pragma once

#include <string>
#include <string_view>

// Pieces of SVG pictures. Not installed.

namespace shlight {

// Text for XML and HTML, within elements and quoted attributes. Control characters are left out.
std::string escape_xml(std::string_view text);

// An element each, on a line of its own; `style` is a list of classes, `anchor` is start, middle or end.
std::string svg_text(double x, double y, std::string_view style, std::string_view anchor, std::string_view content);
std::string svg_line(double x1, double y1, double x2, double y2, std::string_view style);

// The opening tag, the style sheet that plots share, with classes of its own after it, and the page's ground. Colours
// follow the reader's preference for light or dark pages. The picture ends with "</svg>".
std::string svg_begin(double width, double height, std::string_view style, std::string_view dark_style);

}  // namespace shlight
