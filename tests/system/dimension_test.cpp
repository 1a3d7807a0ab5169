#include "system/dimension.h"

#include "base/error.h"
#include "support.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(SimilarityDimension, IsTheLogarithmOfCopiesOverThatOfTheirScale) {
  struct Known {
    const char* name;
    double copies, scale;
  };
  for (const auto& [name, copies, scale] :
       {Known{"gasket", 3, 2}, Known{"carpet", 8, 3}, Known{"koch", 4, 3}, Known{"menger_sponge", 20, 3},
        Known{"cantor_dust", 4, 3}, Known{"twin_dragon", 2, std::sqrt(2.0)}, Known{"terdragon", 3, std::sqrt(3.0)},
        Known{"gosper_island", 7, std::sqrt(7.0)}, Known{"vicsek", 5, 3}, Known{"tetrahedron", 4, 2},
        Known{"minkowski_sausage", 8, 4}, Known{"hexaflake", 7, 3}})
    EXPECT_NEAR(similarity_dimension(*named_system(name)), std::log(copies) / std::log(scale), 16 * epsilon) << name;
}

TEST(SimilarityDimension, OfTheIssue) {
  EXPECT_NEAR(similarity_dimension(*named_system("gasket")), 1.5849625007, 5e-11);
  EXPECT_NEAR(similarity_dimension(*named_system("carpet")), 1.8927892607, 5e-11);
  EXPECT_NEAR(similarity_dimension(*named_system("koch")), 1.2618595071, 5e-11);
  EXPECT_NEAR(similarity_dimension(*named_system("menger_sponge")), 2.7268330279, 5e-11);
  // Moran's equation with ratios 1/2, 1/3, 1/4, one of them reflected.
  const System moran(2, {plane(.5, 0, 0, .5, 0, 0), plane(1. / 3, 0, 0, -1. / 3, 2, 0), plane(0, .25, -.25, 0, 0, 2)});
  EXPECT_NEAR(similarity_dimension(moran), 1.0821314981, 5e-11);
}

TEST(SimilarityDimension, OfOneMapOrOfConstantOnesIsZero) {
  EXPECT_EQ(similarity_dimension(System(2, {plane(.5, 0, 0, .5, 1, 1)})), 0);
  EXPECT_EQ(similarity_dimension(System(2, {plane(0, 0, 0, 0, 1, 1), plane(.5, 0, 0, .5, 0, 0)})), 0);
}

TEST(SimilarityDimension, NamesTheMapThatIsNoSimilarity) {
  try {
    similarity_dimension(*named_system("fern"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::shape);
    EXPECT_EQ(error.index(), 1);
  }
}

}  // namespace
