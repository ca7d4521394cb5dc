MODULE single_edge
  ! job single_edge
  ! job hash c923763f51ba2ff5
  ! machine abb
  ! blade 14 mm long, 1 mm thick: knife
  ! tool z: from the shank out through the tip
  ! tool x: to the edge that leads on a feed along +y
  ! tool y: normal of the flat
  ! stock 24 x 20 x 10 mm
  ! 4 cuts, 18.7 s as planned
  ! fairing, rev B
  ! blade: knife no. 4
  PERS tooldata vc_tool:=[TRUE,[[0.000,0.000,310.000],[1.00000000,0.00000000,0.00000000,0.00000000]],[14.5,[0.000,0.000,140.000],[1,0,0,0],0,0,0]];
  ! work object as the controller has it in wobj5
  CONST jointtarget vc_home:=[[0.0000,0.0000,0.0000,0.0000,45.0000,0.0000],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST num vc_feed1:=200.0;
  CONST num vc_feed2:=300.0;
  CONST num vc_rate1:=90.0;
  CONST speeddata vc_axes:=[250,vc_rate1,5000,1000];
  CONST speeddata vc_speed1:=[vc_feed2,vc_rate1,5000,1000];
  CONST speeddata vc_speed2:=[vc_feed1,vc_rate1,5000,1000];
  CONST zonedata vc_zone:=[FALSE,2.0,2.0,2.0,0.2,2.0,0.2];

  PROC main()
    ConfJ\On;
    ConfL\On;
    SingArea\Off;
    MoveAbsJ vc_home\NoEOffs,vc_axes,fine,vc_tool\WObj:=wobj5;
    ! operation 1: rough vcut with blade knife
    ! layer 1
    MoveJ [[1.428,-11.692,20.000],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_axes,fine,vc_tool\WObj:=wobj5;
    SetDO do1,1;
    WaitDI di7,1;
    ! layer 1 cut 1
    MoveL [[1.428,-11.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    MoveL [[1.428,31.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[1.428,31.692,5.800],[0.23903068,0.90830107,0.34137119,0.03632105],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[1.428,31.692,5.800],[0.00000000,1.00000000,0.00000000,0.00000000],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[1.428,31.692,5.800],[0.03266134,0.90186644,-0.37332079,-0.21494594],[0,-1,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[1.428,31.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[1.428,-11.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    ! layer 1 cut 2
    MoveL [[1.428,-11.692,5.800],[0.02749901,0.93150353,-0.31431509,-0.18097238],[0,-1,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[1.428,-11.692,5.800],[0.00000000,1.00000000,0.00000000,0.00000000],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[5.613,-11.692,5.800],[0.25806289,0.89220810,0.36855201,0.03921302],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,-11.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,31.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,31.692,5.800],[0.23903068,0.90830107,0.34137119,0.03632105],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,31.692,5.800],[0.00000000,1.00000000,0.00000000,0.00000000],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,31.692,5.800],[0.03266134,0.90186644,-0.37332079,-0.21494594],[0,-1,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,31.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,-11.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    ! layer 1 cut 3
    MoveL [[8.476,-11.692,5.800],[0.02749901,0.93150353,-0.31431509,-0.18097238],[0,-1,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[8.476,-11.692,5.800],[0.00000000,1.00000000,0.00000000,0.00000000],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[12.661,-11.692,5.800],[0.25806289,0.89220810,0.36855201,0.03921302],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,-11.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,31.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,31.692,5.800],[0.23903068,0.90830107,0.34137119,0.03632105],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,31.692,5.800],[0.00000000,1.00000000,0.00000000,0.00000000],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,31.692,5.800],[0.03266134,0.90186644,-0.37332079,-0.21494594],[0,-1,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,31.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,-11.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    ! layer 1 cut 4
    MoveL [[15.524,-11.692,5.800],[0.02749901,0.93150353,-0.31431509,-0.18097238],[0,-1,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[15.524,-11.692,5.800],[0.00000000,1.00000000,0.00000000,0.00000000],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[19.709,-11.692,5.800],[0.25806289,0.89220810,0.36855201,0.03921302],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,-11.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,31.692,5.800],[0.40557979,0.70441602,0.57922797,0.06162842],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,31.692,5.800],[0.23903068,0.90830107,0.34137119,0.03632105],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,31.692,5.800],[0.00000000,1.00000000,0.00000000,0.00000000],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,31.692,5.800],[0.03266134,0.90186644,-0.37332079,-0.21494594],[0,-1,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,31.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,-11.692,5.800],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed2,fine,vc_tool\WObj:=wobj5;
    MoveL [[22.572,-11.692,20.000],[0.06162842,0.57922797,-0.70441602,-0.40557979],[0,-1,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1,fine,vc_tool\WObj:=wobj5;
    SetDO do1,0;
    MoveAbsJ vc_home\NoEOffs,vc_axes,fine,vc_tool\WObj:=wobj5;
  ENDPROC
ENDMODULE
