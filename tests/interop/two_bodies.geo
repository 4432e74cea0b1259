// A channel with two holes, half of it of quadrilaterals; every curve is in exactly one group.
DefineConstant[ recombine = 1 ];
h = 0.25;
Point(1) = {0, 0, 0, h};  Point(2) = {1, 0, 0, h};  Point(3) = {2, 0, 0, h};
Point(4) = {2, 1, 0, h};  Point(5) = {1, 1, 0, h};  Point(6) = {0, 1, 0, h};
Point(7) = {1.4, 0.4, 0, h / 2}; Point(8) = {1.6, 0.4, 0, h / 2}; Point(9) = {1.5, 0.6, 0, h / 2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};
Line(5) = {5, 6};  Line(6) = {6, 1};  Line(7) = {2, 5};
Line(8) = {7, 8};  Line(9) = {8, 9};  Line(10) = {9, 7};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Curve Loop(3) = {8, 9, 10};
Plane Surface(1) = {1};
Plane Surface(2) = {2, 3};
If (recombine)
  Transfinite Surface {1};
  Recombine Surface {1};
EndIf
Physical Curve("walls", 7) = {1, 2, 4, 5};
Physical Curve("outlet", 4) = {3};
Physical Curve("body", 23) = {8, 9, 10};
Physical Curve("inlet", 99) = {6};
Physical Surface("fluid", 5) = {1, 2};
