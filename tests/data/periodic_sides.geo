h=0.5;
Point(1)={1,0,0,h};Point(2)={2,0,0,h};Point(3)={2*Cos(Pi/6),2*Sin(Pi/6),0,h};Point(4)={Cos(Pi/6),Sin(Pi/6),0,h};Point(5)={0,0,0,h};
Line(1)={1,2};Circle(2)={2,5,3};Line(3)={3,4};Circle(4)={4,5,1};
Curve Loop(1)={1,2,3,4};Plane Surface(1)={1};
Periodic Curve {3} = {-1} Rotate {{0,0,1},{0,0,0},Pi/6};
Physical Curve("sides")={1,3};
Physical Curve("walls")={2,4};
Physical Surface("dom")={1};
