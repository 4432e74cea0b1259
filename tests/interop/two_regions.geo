// Two squares side by side, quadrilaterals on the left and triangles on the right, a hole, and
// physical groups of every kind: named and unnamed, points, a curve in two groups, one reversed.
SetFactory("Built-in");
h = 0.3;
Point(1) = {0, 0, 0, h};  Point(2) = {1, 0, 0, h};  Point(3) = {2, 0, 0, h};
Point(4) = {2, 1, 0, h};  Point(5) = {1, 1, 0, h};  Point(6) = {0, 1, 0, h};
Point(7) = {1.5, 0.5, 0, h};
Point(8) = {1.7, 0.5, 0, h / 3};  Point(9) = {1.5, 0.7, 0, h / 3};
Point(10) = {1.3, 0.5, 0, h / 3}; Point(11) = {1.5, 0.3, 0, h / 3};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};
Line(5) = {5, 6};  Line(6) = {6, 1};  Line(7) = {2, 5};
Circle(8) = {8, 7, 9};  Circle(9) = {9, 7, 10};  Circle(10) = {10, 7, 11}; Circle(11) = {11, 7, 8};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Curve Loop(3) = {8, 9, 10, 11};
Plane Surface(1) = {1};
Plane Surface(2) = {2, 3};
Transfinite Curve {1, 5} = 4;
Transfinite Curve {6, 7} = 5;
Transfinite Surface {1};
Recombine Surface {1};
Physical Curve("outer wall", 17) = {1, 2, -5};
Physical Curve("outlet", 4) = {3};
Physical Curve("body", 23) = {8, 9, 10, 11};
Physical Curve(99) = {4, 6};
Physical Curve("upper half", 31) = {8, 9};
Physical Point("corner", 3) = {1};
Physical Surface("left", 5) = {1};
Physical Surface("right", 6) = {2};
