// The page of a frame's faces.

#include "apps/output/faces/faces_page.h"
#include "tests/support/output_example.h"

#include <gtest/gtest.h>

namespace gestell::apps
{
namespace
{

TEST(FacesPage, HoldsFiveHundredFacesOfAFineMeshInFiveMegabytes)
{
  const std::string page = faces_page(chequered(23, 8), "plate.step", "0"); // 529 faces, 67 712 triangles
  EXPECT_LT(page.size(), 5000000u);
  EXPECT_NE(page.find("529 faces"), std::string::npos);
  EXPECT_NE(page.find("\"tag\":529"), std::string::npos);
}

TEST(FacesPage, GivesLengthsInTheUnitOfTheFileAndInMetres)
{
  const std::string page = faces_page(chequered(2, 1), "plate.step", "0");
  EXPECT_NE(page.find("250000 mm² = 0.25 m²"), std::string::npos);
  EXPECT_NE(page.find("(1000, 1000, 0) mm = (1, 1, 0) m"), std::string::npos);
}

TEST(FacesPage, IsNotBrokenByANameThatEndsAScript)
{
  const std::string page = faces_page(chequered(2, 1), "plate.step", "0");
  std::size_t       ends = 0;
  for (std::size_t at = page.find("</script>"); at != std::string::npos; at = page.find("</script>", at + 1))
    ++ends;
  EXPECT_EQ(ends, 1u);
}

/// "<!--<script>" would let the page's end tag end nothing.
TEST(FacesPage, IsNotBrokenByANameThatOpensAComment)
{
  coupling::MeshReport report = chequered(2, 1);
  report.surfaces[0].name     = "<!--<script>";
  const std::string page      = faces_page(report, "plate.step", "0");
  const std::size_t data      = page.find("const frame = ");
  ASSERT_NE(data, std::string::npos);
  EXPECT_EQ(page.substr(data, page.find('\n', data) - data).find('<'), std::string::npos);
}

} // namespace
} // namespace gestell::apps
